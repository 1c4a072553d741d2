"""The command line."""

import click

from wayword.cli.common import LazyGroup

_COMMANDS = {
    "drive": "wayword.cli.drive:drive",
    "translate": "wayword.cli.translate:translate",
    "compile": "wayword.cli.compile:compile_",
    "grammar": "wayword.cli.grammar:grammar",
    "explain": "wayword.cli.explain:explain",
}


@click.group(
    cls=LazyGroup,
    commands_at=_COMMANDS,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog="Start with: wayword drive --scenario reference",
)
@click.version_option(package_name="wayword", prog_name="wayword")
def main() -> None:
    """Wayword: talk to an automated vehicle.

    A passenger's words become a program of the Wayword language, which is compiled, validated and executed against a
    simulated automated vehicle. Everything runs offline, on this computer.

    Exit status: 0 done, 1 the work ran and something in it failed, 2 bad usage or input.
    """
