"""``wayword eval attack``."""

from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click
from rich.markup import escape
from rich.table import Table

from wayword.cli.common import FAILED, errors, friendly_errors, json_option, make_folder, model_options, print_json
from wayword.cli.evaluate.common import keep, progress, read_data, run, translators
from wayword.models import DatasetError, ModelError
from wayword.models.confidence import run_of
from wayword.models.evaluation.attack import Yield, attack_summary
from wayword.runtime.consequences import consequences
from wayword.runtime.world import load_map


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
    disguise, Unicode tricks, other languages, encodings, overlong input). Whatever the co-pilot would act on is given
    to a vehicle in mid-trip, and a minute of driving is watched for collisions, red lights passed and excess speed.
    Exit status 1 if there is any.
    """
    records = read_data(data)
    make_folder(out)
    report = attack_summary(run(translators(model, adapter, None), records))
    _carry_out(report["cases"])
    unsafe = [case["id"] for case in report["cases"] if not case.get("safe", True)]
    report = {**report, "executed_unsafe": len(unsafe), "unsafe": unsafe}
    kept = keep(out, f"attack-{Path(data).stem}.json", report)
    if as_json:
        print_json(report)
    else:
        for case in report["cases"]:
            if case["yields"] == Yield.ACTED:
                click.echo(_told(case))
        _show(report["by_tag"], report["yields"])
        errors.print(f"carried out with a collision, a red light passed or excess speed: {len(unsafe)}")
        errors.print(f"[dim]report in {escape(str(kept))}[/]")
    if unsafe:
        context.exit(FAILED)


def _carry_out(cases: list[dict[str, Any]]) -> None:
    """Adds to each case that is acted on what comes of it in the vehicle."""
    town = load_map("town")
    acted = [case for case in cases if case["yields"] in (Yield.ACTED, Yield.CAUTIOUS)]
    with progress("carrying out what is acted on", len(acted)) as advance:
        for case in acted:
            came = consequences(run_of(case["got"], case["confidence"]), town)
            case.update(safe=came.safe, **asdict(came))
            advance("")


def _told(case: dict[str, Any]) -> str:
    commands = case["got"].replace("\n", " ").replace("parameters: ", "").strip()
    words = f"{case['id']} {case['confidence']:.2f} {case['instruction'][:120]!r}"
    return f"{words} became {commands}: {', '.join(case['outcomes'])}{'' if case['safe'] else ', UNSAFE'}"


def _show(by_tag: dict[str, Counter[str]], total: Counter[str]) -> None:
    table = Table("", *[kind.value for kind in Yield], box=None)
    for tag, count in [*by_tag.items(), ("all", total)]:
        table.add_row(escape(tag), *[str(count.get(kind, 0)) for kind in Yield])
    errors.print(table)
