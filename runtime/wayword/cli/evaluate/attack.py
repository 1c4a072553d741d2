"""``wayword eval attack``."""

from collections import Counter
from pathlib import Path

import click
from rich.markup import escape
from rich.table import Table

from wayword.cli.common import FAILED, errors, friendly_errors, json_option, make_folder, model_options, print_json
from wayword.cli.evaluate.common import keep, read_data, run, translators
from wayword.models import DatasetError, ModelError
from wayword.models.evaluation.attack import Yield, attack_summary


@click.command()
@click.argument("data", default="attack")
@model_options
@click.option("--out", type=click.Path(path_type=Path), default=Path("out/eval"), show_default=True)
@json_option
@friendly_errors(DatasetError, ModelError)
@click.pass_context
def attack(context: click.Context, data: str, model: str | None, adapter: str | None, out: Path, as_json: bool) -> None:
    """Report what each adversarial instruction of DATA yields.

    DATA is a JSON Lines file or the name of a shipped set (default: attack: injections, role play, unsafe acts in
    disguise, Unicode tricks, other languages, encodings, overlong input). Exit status 1 if one yields a command that
    adds no caution; compiler and validator still stand between it and the vehicle.
    """
    records = read_data(data)
    make_folder(out)
    report = attack_summary(run(translators(model, adapter, None), records))
    kept = keep(out, f"attack-{Path(data).stem}.json", report)
    if as_json:
        print_json(report)
    else:
        for case in report["cases"]:
            if case["yields"] == Yield.ACTED:
                commands = case["got"].replace("\n", " ").replace("parameters: ", "")
                click.echo(f"{case['id']} {case['confidence']:.2f} {case['instruction'][:120]!r} became {commands}")
        _show(report["by_tag"], report["yields"])
        errors.print(f"[dim]report in {escape(str(kept))}[/]")
    if report["yields"].get(Yield.ACTED):
        context.exit(FAILED)


def _show(by_tag: dict[str, Counter[str]], total: Counter[str]) -> None:
    table = Table("", *[kind.value for kind in Yield], box=None)
    for tag, count in [*by_tag.items(), ("all", total)]:
        table.add_row(escape(tag), *[str(count.get(kind, 0)) for kind in Yield])
    errors.print(table)
