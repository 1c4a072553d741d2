"""The syntax of the Wayword language, and the tools that make constraints for language models from it.

``wayword.lark`` beside this file is the one definition. `constraint` gives the grammar under which a model
may speak about the places of one map; `parser` gives the parser for what it said. The tools between them, a
loader, passes, an emitter, a linter and a generator of sentences, work on any grammar in the supported subset
of Lark.
"""

from collections.abc import Sequence
from functools import lru_cache
from importlib.resources import files

from lark import Lark

from wayword.grammar.diagnostics import Diagnostic, GrammarError, Position
from wayword.grammar.gbnf import to_gbnf
from wayword.grammar.generate import generate
from wayword.grammar.ir import Grammar
from wayword.grammar.lint import check_gbnf, lint_gbnf
from wayword.grammar.loader import load_file, load_text
from wayword.grammar.recognise import is_sentence
from wayword.grammar.specialise import specialise

_FILE = "wayword.lark"
_CACHED_MAPS = 16


@lru_cache(maxsize=1)
def wayword_lark() -> str:
    """Return the text of ``wayword.lark``."""
    return files(__name__).joinpath(_FILE).read_text(encoding="utf-8")


@lru_cache
def load(start: str = "start") -> Grammar:
    """Load the Wayword language.

    Args:
        start: ``start`` for the canonical language, ``source`` for the shape of a hand-written program.
    """
    return load_text(wayword_lark(), _FILE, start)


@lru_cache
def parser(start: str = "start") -> Lark:
    """Return Lark's LALR parser of the Wayword language from a start rule, as `load` takes it.

    Its trees know their positions in the text.
    """
    return Lark(wayword_lark(), start=start, parser="lalr", propagate_positions=True)


def constraint(places: Sequence[str]) -> str:
    """Return the GBNF of the canonical language in which the only places are those of a map.

    Args:
        places: The names on the map, each once, at least one.

    Raises:
        GrammarError: A name is no well-formed place, or is there twice, or there is none.
    """
    return _constraint(tuple(places))


@lru_cache(maxsize=_CACHED_MAPS)
def _constraint(places: tuple[str, ...]) -> str:
    return to_gbnf(specialise(load(), {"PLACE": places}))


__all__ = [
    "Diagnostic",
    "Grammar",
    "GrammarError",
    "Position",
    "check_gbnf",
    "constraint",
    "generate",
    "is_sentence",
    "lint_gbnf",
    "load",
    "load_file",
    "load_text",
    "parser",
    "specialise",
    "to_gbnf",
    "wayword_lark",
]
