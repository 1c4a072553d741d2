"""``wayword compile``: a program to executor instructions."""

import sys

import click

from wayword.cli.common import FAILED, friendly_errors, json_option, map_option, print_json, read_source
from wayword.compiler import Compilation, compile_program, format_command, render_all
from wayword.runtime.world import MapError, load_map


@click.command(name="compile")
@click.argument("source", metavar="FILE|-")
@map_option
@json_option
@friendly_errors(MapError)
def compile_(source: str, map_name: str, as_json: bool) -> None:
    """Compile a Wayword program and print its executor instructions, or what is wrong with it.

    FILE is a program's file, or - for standard input. Places are checked against the map.

    \b
    Examples:
      wayword compile trip.yaml
      wayword translate "Go faster." | wayword compile -
    """
    text = read_source(source, as_json=as_json)
    result = compile_program(text, load_map(map_name).place_names)
    if as_json:
        print_json(to_json(result))
    else:
        _print(result, "<stdin>" if source == "-" else source)
    if not result.ok:
        sys.exit(FAILED)


def to_json(result: Compilation) -> dict[str, object]:
    """The machine-readable form of a compilation."""
    return {
        "ok": result.ok,
        "diagnostics": [diagnostic.to_json() for diagnostic in result.diagnostics],
        "canonical": result.canonical if result.ok else None,
        "instructions": [
            {
                **instruction.to_json(),
                "command": number,
                "line": lowered.command.span.line if lowered.command.span else None,
            }
            for number, lowered in enumerate(result.commands, start=1)
            for instruction in lowered.instructions
        ],
    }


def _print(result: Compilation, name: str) -> None:
    if result.diagnostics:
        click.echo(render_all(result.diagnostics, result.source, name), err=True)
        count = len(result.diagnostics)
        click.echo(f"\n{count} error{'s' if count > 1 else ''}; nothing was compiled", err=True)
    for number, lowered in enumerate(result.commands, start=1):
        line = f", line {lowered.command.span.line}" if lowered.command.span else ""
        click.echo(f"; {number}: {_headline(format_command(lowered.command))}{line}")
        for instruction in lowered.instructions:
            click.echo(str(instruction))


def _headline(program: str) -> str:
    """A command on one line: ``TURN direction=left``."""
    values = [line.split(": ", 1)[1] for line in program.splitlines() if ": " in line]
    _, action, *rest = values
    pairs = [f"{name}={value}" for name, value in zip(rest[::2], rest[1::2], strict=True)]
    return " ".join([action, *pairs])
