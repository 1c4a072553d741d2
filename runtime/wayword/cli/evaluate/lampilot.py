"""``wayword eval lampilot``."""

from pathlib import Path

import click
from rich.markup import escape

from wayword.cli.common import errors, fail, friendly_errors, json_option, make_folder, model_options, print_json
from wayword.cli.evaluate.common import keep, read_data, run, translators
from wayword.cli.evaluate.translation import show
from wayword.models import DatasetError, ModelError
from wayword.models.evaluation.lampilot import lampilot_records
from wayword.models.evaluation.translation import summary


@click.command()
@click.argument("folder", type=click.Path(path_type=Path), required=False)
@click.option("--translation", "translation_only", is_flag=True, help="Judge the translation of its 320 commands.")
@model_options
@click.option("--out", type=click.Path(path_type=Path), default=Path("out/eval"), show_default=True)
@json_option
@friendly_errors(DatasetError, ModelError)
def lampilot(
    folder: Path | None, translation_only: bool, model: str | None, adapter: str | None, out: Path, as_json: bool
) -> None:
    """Judge against LaMPilot-Bench, whose commands nobody here wrote or trains on.

    The commands ship with Wayword (PurdueDigitalTwin/LaMPilot, MIT licence); FOLDER takes them from a copy of its
    folder DbLv1 instead.
    """
    if not translation_only:
        fail("only the translation of its commands can be judged so far: add --translation", as_json=as_json)
    records = read_data("lampilot") if folder is None else lampilot_records(folder)
    make_folder(out)
    report = {"data": "lampilot", **summary(run(translators(model, adapter, None), records))}
    kept = keep(out, "lampilot-translation.json", report)
    if as_json:
        print_json(report)
    else:
        show(report)
        errors.print(f"[dim]report in {escape(str(kept))}[/]")
