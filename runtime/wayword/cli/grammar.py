"""``wayword grammar``: the grammar as a constraint for a model."""

import click

from wayword.cli.common import fail, friendly_errors, map_option
from wayword.grammar import GrammarError, constraint, wayword_lark
from wayword.runtime.world import MapError, load_map


@click.command()
@click.option(
    "--format",
    "format_",
    type=click.Choice(["gbnf", "lark"]),
    default="gbnf",
    show_default=True,
    help="gbnf: llama.cpp's format; lark: the source of it all.",
)
@map_option
@friendly_errors(MapError, GrammarError)
def grammar(format_: str, map_name: str) -> None:
    """Print the grammar of the canonical language.

    The GBNF constraint is generated from wayword.lark; its places are those of the map, so that a model under it
    can't name a place that isn't there.

    \b
    Examples:
      wayword grammar --format gbnf --map town > town.gbnf
      wayword grammar --format lark
    """
    if format_ == "lark":
        click.echo(wayword_lark(), nl=False)
        return
    places = load_map(map_name).place_names
    if not places:
        fail(
            f"map {map_name} names no places, so that there is nothing to specialise the grammar to",
            as_json=False,
        )
    click.echo(constraint(places), nl=False)
