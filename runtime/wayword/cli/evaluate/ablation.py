"""``wayword eval ablation``."""

from pathlib import Path
from typing import Any

import click
from rich.markup import escape
from rich.table import Table

from wayword.cli.common import errors, friendly_errors, json_option, make_folder, print_json
from wayword.cli.evaluate.common import keep, percent, progress, read_data, town_places, translators
from wayword.models import DatasetError, ModelError
from wayword.models.evaluation.ablation import Configuration, configurations, measure
from wayword.models.evaluation.plots import plot_latencies
from wayword.models.evaluation.translation import Result, summary


@click.command()
@click.argument("data", default="benchmark")
@click.option("--every", type=click.IntRange(min=1), default=1, show_default=True, help="Take each N-th instruction.")
@click.option("--out", type=click.Path(path_type=Path), default=Path("out/eval/ablation"), show_default=True)
@json_option
@friendly_errors(DatasetError, ModelError)
def ablation(data: str, every: int, out: Path, as_json: bool) -> None:
    """Compare prompts, with and without tuning, with and without the constraint.

    The published evaluation has four prompts (baseline; no-status; zero-shot; kb-only); here each is taken with the
    bare and the tuned model, under the grammar and free, and the tuned model's own short prompt is added. The whole
    table takes over an hour on two cores. Each result is kept as it comes: an interrupted run goes on where it was.
    """
    records = read_data(data)[::every]
    make_folder(out)
    rows, latencies = [], {}
    for configuration in configurations():
        results = _measure(configuration, records, out)
        figures = summary(results)
        rows.append({"configuration": configuration.name, **figures, "errors": len(figures["errors"])})
        latencies[configuration.name] = [result.latency_ms for result in results]
    keep(out, "ablation.json", rows)
    plot_latencies(latencies, out / "latency.png")
    (out / "ablation.md").write_text(markdown(rows), encoding="utf-8")
    if as_json:
        print_json({"data": data, "n": len(records), "configurations": rows})
        return
    table = Table("configuration", "accuracy", "parse rate", "mean", "median", "95th percentile [ms]", box=None)
    for row in rows:
        table.add_row(*_cells(row))
    errors.print(table)
    errors.print(f"[dim]results, table and box plot in {escape(str(out))}[/]")


def markdown(rows: list[dict[str, Any]]) -> str:
    """The table as Markdown."""
    head = "| configuration | accuracy | parse rate | mean [ms] | median [ms] | 95th percentile [ms] |\n"
    return head + "|---|---|---|---|---|---|\n" + "".join(f"| {' | '.join(_cells(row))} |\n" for row in rows)


def _cells(row: dict[str, Any]) -> list[str]:
    times = row["latency_ms"]
    return [
        row["configuration"],
        percent(row["accuracy"]),
        percent(row["parse_rate"]),
        *(f"{times[key]:.0f}" for key in ("mean", "median", "p95")),
    ]


def _measure(configuration: Configuration, records: list[Any], out: Path) -> list[Result]:
    translator_for = translators(None, None if configuration.tuned else "none", configuration.style)
    kept = out / f"{configuration.name.replace(' ', '-')}.jsonl"
    with progress(configuration.name, len(records)) as advance:
        right = 0

        def on_result(result: Result) -> None:
            nonlocal right
            right += result.correct
            advance(f"{right} right")

        return measure(configuration, translator_for, town_places(), records, kept, on_result)
