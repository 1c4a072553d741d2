"""The intermediate form of a grammar: what a loader makes, a pass rewrites and an emitter prints.

It describes a set of strings, character by character. What only shapes a parser's tree (aliases, the prefixes
``?``, ``_`` and ``!``) is not in it; positions are, but two expressions that differ only in position are
equal.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from wayword.grammar.diagnostics import Position

MAX_CODE_POINT = 0x10FFFF


@dataclass(frozen=True, slots=True)
class Literal:
    """One fixed string."""

    text: str
    position: Position | None = field(default=None, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class CharSet:
    """Any one character of a set.

    Attributes:
        ranges: Inclusive ranges of code points, sorted, neither overlapping nor adjacent.
    """

    ranges: tuple[tuple[int, int], ...]
    position: Position | None = field(default=None, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Sequence:
    """Its items one after the other; with no items, the empty string."""

    items: tuple["Expression", ...]
    position: Position | None = field(default=None, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Choice:
    """Any one of its alternatives; their order has no meaning but is kept for the reader."""

    alternatives: tuple["Expression", ...]
    position: Position | None = field(default=None, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Repeat:
    """Its body ``min`` to ``max`` times; without a bound where ``max`` is None."""

    body: "Expression"
    min: int
    max: int | None
    position: Position | None = field(default=None, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Reference:
    """Whatever the named rule or terminal describes."""

    name: str
    position: Position | None = field(default=None, compare=False, repr=False, kw_only=True)


Expression: TypeAlias = Literal | CharSet | Sequence | Choice | Repeat | Reference


@dataclass(frozen=True, slots=True)
class Rule:
    """A named expression: a rule, a terminal or an instance of a template.

    Attributes:
        name: The name in the source; an instance of a template is called like its use, ``list{item}``.
        body: What it describes.
        is_terminal: Whether the source defines it as a terminal.
    """

    name: str
    body: Expression
    is_terminal: bool = False
    position: Position | None = field(default=None, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Grammar:
    """Rules by name, and where to start.

    Attributes:
        start: Name of the start rule.
        rules: All rules by name, in the order in which they are reached from the start.
        provenance: What the grammar was made from, one remark each, for a generated file's header.
    """

    start: str
    rules: Mapping[str, Rule]
    provenance: tuple[str, ...] = field(default=(), compare=False)

    def with_rules(self, rules: Iterable[Rule]) -> "Grammar":
        """Return the same grammar with other rules."""
        return replace(self, rules={rule.name: rule for rule in rules})


def char_set(ranges: Iterable[tuple[int, int]], position: Position | None = None) -> CharSet:
    """Make a set from ranges in any order, joining those that overlap or touch."""
    joined: list[tuple[int, int]] = []
    for low, high in sorted(ranges):
        if joined and low <= joined[-1][1] + 1:
            joined[-1] = (joined[-1][0], max(joined[-1][1], high))
        else:
            joined.append((low, high))
    return CharSet(tuple(joined), position=position)


def complement(ranges: Iterable[tuple[int, int]]) -> tuple[tuple[int, int], ...]:
    """Return the ranges of all code points that are not in sorted, disjoint ``ranges``."""
    gaps: list[tuple[int, int]] = []
    following = 0
    for low, high in ranges:
        if following < low:
            gaps.append((following, low - 1))
        following = high + 1
    if following <= MAX_CODE_POINT:
        gaps.append((following, MAX_CODE_POINT))
    return tuple(gaps)


def sequence(items: Iterable[Expression], position: Position | None = None) -> Expression:
    """Make a sequence without nested sequences; a single item stands for itself."""
    flat: list[Expression] = []
    for item in items:
        flat.extend(item.items if isinstance(item, Sequence) else (item,))
    return flat[0] if len(flat) == 1 else Sequence(tuple(flat), position=position)


def choice(alternatives: Iterable[Expression], position: Position | None = None) -> Expression:
    """Make a choice without nested or repeated alternatives; a single one stands for itself."""
    flat: dict[Expression, None] = {}
    for alternative in alternatives:
        nested = alternative.alternatives if isinstance(alternative, Choice) else (alternative,)
        flat.update(dict.fromkeys(nested))
    return next(iter(flat)) if len(flat) == 1 else Choice(tuple(flat), position=position)


def parts(expression: Expression) -> tuple[Expression, ...]:
    """Return the direct parts of an expression."""
    match expression:
        case Sequence(items):
            return items
        case Choice(alternatives):
            return alternatives
        case Repeat(body):
            return (body,)
        case _:
            return ()


def walk(expression: Expression) -> Iterator[Expression]:
    """Yield the expression and everything in it, outside in, left to right."""
    pending = [expression]
    while pending:
        current = pending.pop()
        yield current
        pending.extend(reversed(parts(current)))


def references(expression: Expression) -> Iterator[Reference]:
    """Yield every reference in the expression, left to right."""
    return (part for part in walk(expression) if isinstance(part, Reference))


def rewrite(expression: Expression, visit: Callable[[Expression], Expression]) -> Expression:
    """Rebuild an expression bottom up: ``visit`` sees each part after its own parts were rewritten."""
    match expression:
        case Sequence(items):
            expression = sequence((rewrite(item, visit) for item in items), expression.position)
        case Choice(alternatives):
            expression = choice((rewrite(each, visit) for each in alternatives), expression.position)
        case Repeat(body):
            expression = replace(expression, body=rewrite(body, visit))
    return visit(expression)
