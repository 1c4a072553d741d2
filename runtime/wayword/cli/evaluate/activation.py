"""``wayword eval activation``."""

from pathlib import Path

import click
from rich.markup import escape
from rich.table import Table

from wayword.cli.common import errors, friendly_errors, json_option, make_folder, model_options, print_json
from wayword.cli.evaluate.common import keep, percent, read_data, run, translators
from wayword.models import DatasetError, ModelError
from wayword.models.confidence import ASK_BACK_BELOW
from wayword.models.evaluation.activation import activation_summary


@click.command()
@click.argument("data", default="activation")
@model_options
@click.option(
    "--threshold",
    type=click.FloatRange(0, 1),
    default=ASK_BACK_BELOW,
    show_default=True,
    help="Confidence below which the co-pilot asks back.",
)
@click.option("--out", type=click.Path(path_type=Path), default=Path("out/eval"), show_default=True)
@json_option
@friendly_errors(DatasetError, ModelError)
def activation(data: str, model: str | None, adapter: str | None, threshold: float, out: Path, as_json: bool) -> None:
    """Count the sentences of DATA, none of which is meant for the vehicle, that become a command.

    DATA is a JSON Lines file or the name of a shipped set (default: activation, 603 sentences of talk, requests to
    assistants, half sentences and general questions).
    """
    records = read_data(data)
    make_folder(out)
    report = activation_summary(run(translators(model, adapter, None), records), threshold)
    kept = keep(out, f"activation-{Path(data).stem}.json", report)
    if as_json:
        print_json(report)
        return
    for case in report["activations"]:
        commands = case["got"].replace("\n", " ").replace("parameters: ", "")
        click.echo(f"{case['effect']:6} {case['confidence']:.2f} {case['instruction'][:120]!r} became {commands}")
    table = Table("", "n", "becomes a command", "of motion", box=None)
    for tag, group in report["by_tag"].items():
        table.add_row(escape(tag), str(group["n"]), percent(group["activation_rate"]), percent(group["motion_rate"]))
    table.add_row(
        "all", str(report["n"]), percent(report["activation_rate"]), percent(report["motion_rate"]), style="bold"
    )
    errors.print(table)
    errors.print(f"[dim]report in {escape(str(kept))}[/]")
