"""Says whether a text is a sentence: slow, but straight from the definition of the intermediate form.

It has no use for an engine's tricks, so that it can be the judge over emitters, engines and Lark's own
parser.
"""

from functools import cache

from wayword.grammar.analysis import Rules
from wayword.grammar.ir import CharSet, Choice, Expression, Grammar, Literal, Reference, Repeat, Sequence


def is_sentence(grammar: Grammar, text: str) -> bool:
    """Say whether the start rule of a grammar without left recursion describes ``text``."""
    return matches(grammar.rules, Reference(grammar.start), text)


def matches(rules: Rules, expression: Expression, text: str) -> bool:
    """Say whether an expression describes the whole of ``text``."""
    return len(text) in _Recogniser(rules, text).ends(expression, 0)


class _Recogniser:
    def __init__(self, rules: Rules, text: str) -> None:
        self._rules = rules
        self._text = text
        self._rule_ends = cache(lambda name, start: frozenset(self.ends(rules[name].body, start)))

    def ends(self, expression: Expression, start: int) -> set[int]:
        """Return every position at which a match that begins at ``start`` can end."""
        match expression:
            case Literal(text):
                return {start + len(text)} if self._text.startswith(text, start) else set()
            case CharSet(ranges):
                return {start + 1} if start < len(self._text) and _holds(ranges, self._text[start]) else set()
            case Sequence(items):
                return self._sequence(items, start)
            case Choice(alternatives):
                return {end for each in alternatives for end in self.ends(each, start)}
            case Repeat():
                return self._repeat(expression, start)
            case Reference(name):
                return set(self._rule_ends(name, start))

    def _sequence(self, items: tuple[Expression, ...], start: int) -> set[int]:
        reached = {start}
        for item in items:
            reached = {end for each in reached for end in self.ends(item, each)}
        return reached

    def _repeat(self, repeat: Repeat, start: int) -> set[int]:
        found: set[int] = {start} if repeat.min == 0 else set()
        reached, times = {start}, 0
        while reached and (repeat.max is None or times < repeat.max):
            reached = {end for each in reached for end in self.ends(repeat.body, each)}
            times += 1
            if times >= repeat.min:
                reached -= found  # What was found is followed already.
                found |= reached
        return found


def _holds(ranges: tuple[tuple[int, int], ...], character: str) -> bool:
    return any(low <= ord(character) <= high for low, high in ranges)
