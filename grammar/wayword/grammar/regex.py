"""Translates regular expressions into the intermediate form, by way of Python's own regex parser.

Only what describes a regular language from the text alone has a translation. A construct that looks around,
refers back or depends on the locale or on Unicode's tables raises `RegexError`.
"""

import re
import warnings
from collections.abc import Callable, Iterable
from functools import cache
from itertools import groupby
from re import _constants as op
from re import _parser
from typing import Any

from wayword.grammar.diagnostics import Position
from wayword.grammar.ir import (
    MAX_CODE_POINT,
    CharSet,
    Expression,
    Literal,
    Repeat,
    char_set,
    choice,
    complement,
    sequence,
)

_LOOK = {(1, op.ASSERT): "lookahead", (-1, op.ASSERT): "lookbehind"}
_LOOK |= {(1, op.ASSERT_NOT): "negative lookahead", (-1, op.ASSERT_NOT): "negative lookbehind"}
# Python's codes are integers that begin at 0 for each kind, so that kinds can't share a table.
_ANCHORS = {
    op.AT_BOUNDARY: r"word boundary \b",
    op.AT_NON_BOUNDARY: r"word boundary \B",
    op.AT_BEGINNING: "anchor ^",
    op.AT_BEGINNING_STRING: r"anchor \A",
    op.AT_END: "anchor $",
    op.AT_END_STRING: r"anchor \Z",
}
_REFUSED = {
    op.GROUPREF: "backreference",
    op.GROUPREF_EXISTS: "conditional group",
    op.POSSESSIVE_REPEAT: "possessive repetition",
    op.ATOMIC_GROUP: "atomic group",
    op.FAILURE: "a pattern that never matches",
}
_CATEGORIES = {
    op.CATEGORY_DIGIT: r"\d",
    op.CATEGORY_NOT_DIGIT: r"\D",
    op.CATEGORY_SPACE: r"\s",
    op.CATEGORY_NOT_SPACE: r"\S",
    op.CATEGORY_WORD: r"\w",
    op.CATEGORY_NOT_WORD: r"\W",
}
_ASCII_CLASS = {"d": "[0-9]", "s": r"[ \t\n\r\f\v]", "w": "[A-Za-z0-9_]"}
_Ranges = Iterable[tuple[int, int]]


class RegexError(ValueError):
    """A regular expression, or a construct in it, that has no translation.

    Attributes:
        construct: The construct as a person would call it.
        message: Why it has no translation.
        help: A way out.
    """

    def __init__(self, construct: str, message: str, help: str) -> None:  # noqa: A002
        super().__init__(message)
        self.construct, self.message, self.help = construct, message, help


def translate(pattern: str, flags: Iterable[str] = (), position: Position | None = None) -> Expression:
    """Translate a regular expression.

    Args:
        pattern: A regular expression in Python's syntax.
        flags: Lark's flags, a set of the letters ``imsux``.
        position: The position that every expression made here gets.

    Raises:
        RegexError: The pattern is malformed or has no translation.
    """
    bits = 0
    for flag in flags:
        bits |= re.RegexFlag[flag.upper()]
    try:
        with warnings.catch_warnings():  # Of what future versions may read differently: this one reads it so.
            warnings.simplefilter("ignore", FutureWarning)
            parsed = _parser.parse(f"(?:{pattern})", bits)  # Lark puts the pattern in a group as well.
    except (re.error, ValueError) as error:
        raise RegexError("regular expression", str(error), "see Python's re module") from error
    return _Translator(position).items(parsed, bits)


class _Translator:
    """Walks Python's parse of a pattern; flags are handed down, since a group can change them."""

    def __init__(self, position: Position | None) -> None:
        self._position = position
        self._handlers: dict[Any, Callable[[Any, int], Expression]] = {
            op.NOT_LITERAL: lambda code, flags: self._set([(code, code)], flags, negated=True),
            op.ANY: self._any,
            op.IN: self._in,
            op.BRANCH: self._branch,
            op.SUBPATTERN: self._group,
            op.MAX_REPEAT: self._repeat,
            op.MIN_REPEAT: self._repeat,  # Lazy and greedy: the same language.
        }

    def items(self, parsed: Any, flags: int) -> Expression:
        """Translate a run of nodes, joining neighbouring characters into one literal."""
        found: list[Expression] = []
        for is_literal, run in groupby(parsed, key=lambda node: node[0] is op.LITERAL):
            if is_literal:
                found.extend(self._literals([code for _, code in run], flags))
            else:
                found.extend(self._node(kind, value, flags) for kind, value in run)
        return sequence(found, self._position)

    def _node(self, kind: Any, value: Any, flags: int) -> Expression:
        if kind in (op.ASSERT, op.ASSERT_NOT):
            raise _refused(_LOOK[value[0], kind])
        if kind is op.AT:
            raise _refused(_ANCHORS[value])
        if kind not in self._handlers:
            raise _refused(_REFUSED[kind])
        return self._handlers[kind](value, flags)

    def _literals(self, codes: list[int], flags: int) -> Iterable[Expression]:
        if flags & re.IGNORECASE:
            return [self._set([(code, code)], flags) for code in codes]
        return [Literal("".join(map(chr, codes)), position=self._position)]

    def _set(self, ranges: _Ranges, flags: int, *, negated: bool = False) -> CharSet:
        found = char_set(ranges).ranges
        if flags & re.IGNORECASE:
            found = ignoring_case(found, flags & re.ASCII)
        return CharSet(complement(found) if negated else found, position=self._position)

    def _any(self, _: None, flags: int) -> Expression:
        excluded = () if flags & re.DOTALL else ((10, 10),)
        return CharSet(complement(excluded), position=self._position)

    def _in(self, members: list[tuple[Any, Any]], flags: int) -> Expression:
        negated = members[0][0] is op.NEGATE
        ranges: list[tuple[int, int]] = []
        for kind, value in members[negated:]:
            if kind is op.CATEGORY:
                ranges.extend(_category(_CATEGORIES[value], flags))
            else:
                ranges.append(value if kind is op.RANGE else (value, value))
        return self._set(ranges, flags, negated=negated)

    def _branch(self, value: tuple[None, list[Any]], flags: int) -> Expression:
        return choice((self.items(alternative, flags) for alternative in value[1]), self._position)

    def _group(self, value: tuple[Any, int, int, Any], flags: int) -> Expression:
        _, added, removed, body = value
        return self.items(body, (flags | added) & ~removed)

    def _repeat(self, value: tuple[int, Any, Any], flags: int) -> Expression:
        low, high, body = value
        bound = None if high is op.MAXREPEAT else int(high)
        return Repeat(self.items(body, flags), low, bound, position=self._position)


@cache
def ignoring_case(ranges: tuple[tuple[int, int], ...], flags: int = 0) -> tuple[tuple[int, int], ...]:
    """Return every character that Python's engine takes for one in ``ranges`` under the flag ``i``.

    The engine itself is asked, since its rules go beyond upper and lower case (``k`` also matches the Kelvin
    sign).
    """
    members = "".join(f"\\U{low:08x}-\\U{high:08x}" for low, high in ranges)
    return _ranges_matching(f"[{members}]", flags | re.IGNORECASE)


def _ranges_matching(one_character: str, flags: int) -> tuple[tuple[int, int], ...]:
    """Return all characters that a pattern for one character matches, as ranges of code points."""
    runs = re.finditer(f"{one_character}+", _every_character(), flags)
    return tuple((run.start(), run.end() - 1) for run in runs)


@cache
def _every_character() -> str:
    return "".join(map(chr, range(MAX_CODE_POINT + 1)))


def _category(name: str, flags: int) -> tuple[tuple[int, int], ...]:
    if not flags & re.ASCII:
        ascii_class = _ASCII_CLASS[name[1].lower()]
        negated = ascii_class.replace("[", "[^") if name[1].isupper() else ascii_class
        raise RegexError(
            f"category {name}",
            "it depends on the version of Unicode's tables",
            f"write {negated} or (?a:{name})",
        )
    return _ranges_matching(name, re.ASCII)


def _refused(construct: str) -> RegexError:
    return RegexError(
        construct,
        "it has no counterpart in a context-free grammar",
        "spell out the accepted text with classes, alternatives and repetition",
    )
