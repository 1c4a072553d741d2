"""Makes random sentences of a grammar, for tests and for looking at what it describes."""

from collections.abc import Mapping
from random import Random

from wayword.grammar.diagnostics import Diagnostic, GrammarError
from wayword.grammar.ir import CharSet, Choice, Expression, Grammar, Literal, Reference, Repeat, Sequence

MAX_EXTRA = 4
"""How many more times than it must a repetition is made, at most."""

_PRINTABLE_ASCII = (0x20, 0x7E)
_SURROGATES = (0xD800, 0xDFFF)


def generate(grammar: Grammar, random: Random, budget: int = 200) -> str:
    """Return a random sentence.

    Args:
        grammar: Left recursion is no hindrance.
        random: The source of randomness; the same state gives the same sentence.
        budget: How many expressions may be expanded freely. After that the shortest way to an end is taken, so
            that a sentence always comes to one, however the rules refer to each other.

    Raises:
        GrammarError: The start rule derives no finite sentence.
    """
    heights = _heights(grammar)
    if grammar.start not in heights:
        position = grammar.rules[grammar.start].position
        message = "it derives no finite text"
        raise GrammarError([Diagnostic(position, f"rule {grammar.start}", message, "add an alternative that ends")])
    text: list[str] = []
    pending: list[Expression] = [Reference(grammar.start)]
    while pending:
        budget -= 1
        match pending.pop():
            case Literal(literal):
                text.append(literal)
            case CharSet(ranges):
                text.append(_character(ranges, random))
            case Sequence(items):
                pending.extend(reversed(items))
            case Choice(alternatives):
                pending.append(_alternative(alternatives, heights, random, budget))
            case Repeat() as repeat:
                pending.extend([repeat.body] * _times(repeat, heights, random, budget))
            case Reference(name):
                pending.append(grammar.rules[name].body)
    return "".join(text)


def _alternative(
    alternatives: tuple[Expression, ...], heights: Mapping[str, int], random: Random, budget: int
) -> Expression:
    ending = [each for each in alternatives if _height(each, heights) is not None]
    if budget > 0:
        return random.choice(ending)
    return min(ending, key=lambda each: _height(each, heights) or 0)


def _times(repeat: Repeat, heights: Mapping[str, int], random: Random, budget: int) -> int:
    if budget <= 0 or _height(repeat.body, heights) is None:
        return repeat.min
    most = repeat.min + MAX_EXTRA
    return random.randint(repeat.min, most if repeat.max is None else min(most, repeat.max))


def _character(ranges: tuple[tuple[int, int], ...], random: Random) -> str:
    """Pick a character, mostly a printable ASCII one where there is one."""
    common = _within(ranges, *_PRINTABLE_ASCII)
    low, high = random.choice(common if common and random.random() < 0.9 else _spellable(ranges))
    return chr(random.randint(low, high))


def _spellable(ranges: tuple[tuple[int, int], ...]) -> list[tuple[int, int]]:
    """Leave out surrogates, which no text can hold."""
    spans = _within(ranges, 0, _SURROGATES[0] - 1) + _within(ranges, _SURROGATES[1] + 1, 0x10FFFF)
    return spans or list(ranges)


def _within(ranges: tuple[tuple[int, int], ...], low: int, high: int) -> list[tuple[int, int]]:
    clipped = ((max(low, begin), min(high, end)) for begin, end in ranges)
    return [(begin, end) for begin, end in clipped if begin <= end]


def _heights(grammar: Grammar) -> dict[str, int]:
    """Return the depth of each rule's shallowest derivation; rules without a finite one are left out."""
    heights: dict[str, int] = {}
    level = 0
    while True:
        # A rule found in this round needs one found in the last, so that the height is the number of the round.
        found = [
            name
            for name, rule in grammar.rules.items()
            if name not in heights and _height(rule.body, heights) is not None
        ]
        if not found:
            return heights
        heights.update(dict.fromkeys(found, level))
        level += 1


def _height(expression: Expression, heights: Mapping[str, int]) -> int | None:
    """Return how deep references nest in the shallowest derivation; None where there is no finite one."""
    match expression:
        case Reference(name):
            return heights[name] + 1 if name in heights else None
        case Sequence(items):
            inner = [_height(item, heights) for item in items]
            return None if None in inner else max((each for each in inner if each is not None), default=0)
        case Choice(alternatives):
            ending = [_height(each, heights) for each in alternatives]
            return min((each for each in ending if each is not None), default=None)
        case Repeat(body, low):
            return _height(body, heights) if low else 0
    return 0
