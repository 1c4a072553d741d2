"""``wayword eval translation``."""

from pathlib import Path

import click
from rich.markup import escape
from rich.table import Table

from wayword.cli.common import errors, friendly_errors, json_option, make_folder, model_options, print_json
from wayword.cli.evaluate.common import keep, percent, read_data, run, town_places, translators
from wayword.models import DatasetError, ModelError, PromptStyle
from wayword.models.evaluation.translation import summary


@click.command()
@click.argument("data", default="benchmark")
@click.option(
    "--config",
    type=click.Choice([style.value for style in PromptStyle]),
    default=PromptStyle.TUNED.value,
    show_default=True,
    help="What the prompt tells: tuned, the short one; baseline, knowledge base, examples and vehicle status; "
    "no-status; zero-shot, no examples; kb-only, neither.",
)
@model_options
@click.option("--every", type=click.IntRange(min=1), default=1, show_default=True, help="Take each N-th instruction.")
@click.option("--no-constraint", is_flag=True, help="Let the bare model speak, without the grammar.")
@click.option("--out", type=click.Path(path_type=Path), default=Path("out/eval"), show_default=True)
@json_option
@friendly_errors(DatasetError, ModelError)
def translation(
    data: str,
    config: str,
    every: int,
    model: str | None,
    adapter: str | None,
    no_constraint: bool,
    out: Path,
    as_json: bool,
) -> None:
    """Translate every instruction of DATA, offline, and compare with the programs that were meant.

    DATA is a JSON Lines file or the name of a shipped set (default: benchmark). Programs count as equal if they are
    so after compiling. The whole report is kept in out/eval/.

    \b
    Examples:
      wayword eval translation
      wayword eval translation mine.jsonl --json
      wayword eval translation --adapter none --config baseline
    """
    records = read_data(data)[::every]
    make_folder(out)
    translator_for = translators(model, adapter, PromptStyle(config))
    results = run(translator_for, records, constrained=not no_constraint)
    report = {
        "data": data,
        "config": config,
        "model": translator_for(town_places()).model.name,
        "constrained": not no_constraint,
        **summary(results),
    }
    kept = keep(out, f"translation-{Path(data).stem}-{config}{'-free' if no_constraint else ''}.json", report)
    if as_json:
        print_json(report)
    else:
        show(report)
        errors.print(f"[dim]report in {escape(str(kept))}[/]")


def show(report: dict[str, object]) -> None:
    """Prints the figures as a table and every error."""
    table = Table("", "n", "correct", "accuracy", box=None)
    for kind in ("by_category", "by_tag"):
        groups = report[kind]
        assert isinstance(groups, dict)
        for name, group in groups.items():
            table.add_row(escape(name), str(group["n"]), str(group["correct"]), percent(group["accuracy"]))
    table.add_section()
    table.add_row("all", str(report["n"]), str(report["correct"]), percent(report["accuracy"]), style="bold")
    listed = report["errors"]
    assert isinstance(listed, list)
    for error in listed:
        click.echo(f"{error['id']}: {error['instruction'][:200]}")
        click.echo(_indented("expected", error["expected"]) + _indented("got", error["got"]), nl=False)
    errors.print(table)
    times = report["latency_ms"]
    assert isinstance(times, dict)
    errors.print(
        f"parse rate {percent(report['parse_rate'])}; latency mean {times['mean']} ms, "
        f"median {times['median']} ms, 95th percentile {times['p95']} ms"
    )


def _indented(title: str, program: str) -> str:
    lines = program.rstrip("\n").split("\n")
    return "".join(f"  {title if number == 0 else '':9}{line}\n" for number, line in enumerate(lines))
