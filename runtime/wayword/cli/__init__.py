"""The command line."""

import sys
from io import TextIOWrapper

import click

from wayword.cli.common import LazyCommand, LazyGroup

_COMMANDS = {
    "drive": LazyCommand("wayword.cli.drive", "drive", "Drive a scenario: from sentences to a moving car."),
    "translate": LazyCommand("wayword.cli.translate", "translate", "Translate a passenger's words into a program."),
    "compile": LazyCommand("wayword.cli.compile", "compile_", "Compile a program to executor instructions."),
    "grammar": LazyCommand("wayword.cli.grammar", "grammar", "Print the grammar, as a constraint for a model."),
    "eval": LazyCommand("wayword.cli.evaluate", "evaluate", "Measure how well instructions are translated."),
    "train": LazyCommand("wayword.cli.train", "train", "Fine-tune the translation model."),
    "explain": LazyCommand("wayword.cli.explain", "explain", "Explain a diagnostic code."),
}


@click.group(
    cls=LazyGroup,
    lazy=_COMMANDS,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog="Start with: wayword drive --programs (the vehicle alone), then wayword drive (with the model)",
)
@click.version_option(package_name="wayword", prog_name="wayword")
def main() -> None:
    """Wayword: talk to an automated vehicle.

    A passenger's words become a program of the Wayword language, which is compiled, validated and executed against a
    simulated automated vehicle. Everything runs offline, on this computer.

    Exit status: 0 done, 1 the work ran and something in it failed, 2 bad usage or input.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")  # a terminal that can't show “ shows ? instead
