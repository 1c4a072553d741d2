"""``wayword explain``: what a diagnostic code means."""

import click

from wayword.cli.common import fail
from wayword.compiler import CODES


@click.command()
@click.argument("code", required=False)
def explain(code: str | None) -> None:
    """Explain a diagnostic code such as WW0303, or list all codes.

    \b
    Examples:
      wayword explain WW0303
      wayword explain
    """
    if code is None:
        for known in CODES.values():
            click.echo(f"{known.name}  {known.title}")
        return
    found = CODES.get(code.upper())
    if found is None:
        fail(f"no diagnostic has the code {code}; `wayword explain` lists them all", as_json=False)
    click.echo(f"{found.name}: {found.title}\n\n{found.explanation}")
