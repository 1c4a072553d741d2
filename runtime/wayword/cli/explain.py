"""``wayword explain``: what a diagnostic code means."""

import click

from wayword.cli.common import fail, json_option, print_json
from wayword.compiler import CODES


@click.command()
@click.argument("code", required=False)
@json_option
def explain(code: str | None, as_json: bool) -> None:
    """Explain a diagnostic code such as WW0303, or list all codes.

    \b
    Examples:
      wayword explain WW0303
      wayword explain
    """
    if code is not None and code.upper() not in CODES:
        fail(f"no diagnostic has the code {code}; `wayword explain` lists them all", as_json=as_json)
    chosen = [CODES[code.upper()]] if code else list(CODES.values())
    if as_json:
        print_json({known.name: {"title": known.title, "explanation": known.explanation} for known in chosen})
        return
    if code is None:
        for known in chosen:
            click.echo(f"{known.name}  {known.title}")
        return
    (found,) = chosen
    click.echo(f"{found.name}: {found.title}\n\n{found.explanation}")
