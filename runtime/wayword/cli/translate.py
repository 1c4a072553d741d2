"""``wayword translate``: words to a program."""

import sys

import click
from pydantic import ValidationError
from rich.markup import escape

from wayword.cli.common import (
    FAILED,
    errors,
    fail,
    friendly_errors,
    json_option,
    map_option,
    model_options,
    print_json,
)
from wayword.cli.model import load_translator
from wayword.compiler import VehicleStatus, compile_program, render_all
from wayword.models import InstructionError, ModelError
from wayword.models.confidence import asks_back
from wayword.models.validation import explain
from wayword.runtime.world import MapError, load_map


@click.command()
@click.argument("text")
@map_option
@model_options
@click.option(
    "--status",
    "status_json",
    metavar="JSON",
    help='Vehicle status, for example \'{"speed_kmh": 40, "under_way": true}\'.',
)
@click.option("--no-constraint", is_flag=True, help="Let the bare model speak, without the grammar.")
@click.option("--temperature", type=click.FloatRange(min=0), default=0.0, show_default=True, help="0: most probable.")
@click.option("--seed", type=int, default=0, show_default=True, help="For temperatures above 0.")
@json_option
@friendly_errors(MapError, ModelError, InstructionError)
def translate(
    text: str,
    map_name: str,
    model: str | None,
    adapter: str | None,
    status_json: str | None,
    no_constraint: bool,
    temperature: float,
    seed: int,
    as_json: bool,
) -> None:
    """Translate TEXT, what a passenger says, into a program of the Wayword language, offline.

    The program goes to standard output, so that it can be piped into `wayword compile -`. Each call loads the model
    anew; the first one ever merges the adapter into the embedded model.

    \b
    Examples:
      wayword translate "Turn left at the next crossing."
      wayword translate --json "No faster than fifty."
      wayword translate --no-constraint "Take me home."
    """
    if not text.strip():
        fail("there is no instruction: TEXT is empty", as_json=as_json)
    status = _status(status_json, as_json)
    translator, load_s = load_translator(model, adapter, load_map(map_name).place_names)
    result = translator.translate(text, status, constrained=not no_constraint, temperature=temperature, seed=seed)
    compiled = compile_program(result.program, translator.places)
    if as_json:
        print_json(
            {
                "program": result.program,
                "latency_ms": round(result.latency_ms, 1),
                "tokens": result.tokens,
                "forced_tokens": result.forced_tokens,
                "confidence": round(result.confidence, 4),
                "asks_back": asks_back(result),
                "model": translator.model.name,
                "constrained": not no_constraint,
                "finished": result.finished,
                "load_ms": round(load_s * 1000, 1),
                "compiles": compiled.ok,
                "diagnostics": [diagnostic.to_json() for diagnostic in compiled.diagnostics],
            }
        )
    else:
        click.echo(result.program, nl=not result.program.endswith("\n"))
        seconds, rate = result.latency_ms / 1000, result.tokens / result.latency_ms * 1000
        name = escape(translator.model.name)
        errors.print(f"[dim]{result.tokens} tokens in {seconds:.2f} s ({rate:.0f}/s), {name}[/]")
        if not compiled.ok and not no_constraint:
            click.echo(render_all(compiled.diagnostics, result.program, "<translation>"), err=True)
    if not compiled.ok and not no_constraint:
        sys.exit(FAILED)


def _status(status_json: str | None, as_json: bool) -> VehicleStatus:
    if status_json is None:
        return VehicleStatus()
    try:
        return VehicleStatus.model_validate_json(status_json)
    except ValidationError as error:
        fail(f"--status: {explain(error, VehicleStatus)}", as_json=as_json)
