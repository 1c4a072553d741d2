"""Reads GBNF as llama.cpp does, but says what is wrong where llama.cpp crashes, hangs or silently differs.

The notation is that of llama.cpp's ``src/llama-grammar.cpp``: rules ``name ::= alternatives``, one to a line
unless in parentheses or after ``::=`` and ``|``; strings, classes, ``.``, groups; ``* + ? {m} {m,} {m,n}``;
comments from ``#``. Elements that name tokens (``<think>``) are refused: which text they stand for depends on
a vocabulary. So are empty alternatives, which are legal but nearly always a slip.
"""

import re
from dataclasses import dataclass

from wayword.grammar.diagnostics import Diagnostic
from wayword.grammar.gbnf_scanner import GbnfSyntaxError, Scanner
from wayword.grammar.ir import (
    MAX_CODE_POINT,
    CharSet,
    Expression,
    Literal,
    Reference,
    Repeat,
    Rule,
    choice,
    sequence,
)

MAX_REPETITIONS = 2000
"""llama.cpp's limit on a bound, and on the number of rules that one repetition may make."""
MAX_NESTING = 100
"""Groups within groups. llama.cpp has no limit and overflows its stack."""

_DEFINED_AS = re.compile(r"[ \t]*::=")
_BOUNDS = re.compile(r"\{\s*(\d+)\s*(,\s*(\d+)?\s*)?\}")
_SIGNS: dict[str, tuple[int, int | None]] = {"*": (0, None), "+": (1, None), "?": (0, 1)}


@dataclass(slots=True)
class _Item:
    """An element of a sequence, and the number of rules at which llama.cpp reckons it when it is repeated."""

    expression: Expression
    weight: int = 1


class GbnfParser:
    """Parses one text.

    Attributes:
        rules: The rules that could be read.
        diagnostics: What could not.
    """

    def __init__(self, text: str, file: str = "<gbnf>") -> None:
        self.rules: dict[str, Rule] = {}
        self.diagnostics: list[Diagnostic] = []
        self._scanner = Scanner(text, file)
        # llama.cpp counts the names seen so far and the rules made for groups and repetitions. A group's weight is
        # by how much the count has grown in it.
        self._names: set[str] = set()
        self._generated = 0
        self._parse()

    def _parse(self) -> None:
        scanner = self._scanner
        scanner.skip_space(newlines=True)
        while not scanner.at_end:
            try:
                self._rule()
            except GbnfSyntaxError as error:
                position = scanner.position(error.offset)
                self.diagnostics.append(Diagnostic(position, error.construct, error.message, error.way_out))
                scanner.offset = error.offset
                scanner.skip_to_next_rule()
            scanner.skip_space(newlines=True)

    def _rule(self) -> None:
        scanner, begin = self._scanner, self._scanner.offset
        name = scanner.name()
        self._names.add(name)
        if not scanner.take(_DEFINED_AS):
            raise GbnfSyntaxError(begin, f"rule {name}", "it has no ::=", "write: name ::= ...")
        scanner.skip_space(newlines=True)
        if scanner.at_end or scanner.at_rule_head():
            raise GbnfSyntaxError(begin, f"rule {name}", "it is empty", 'write "" for the empty string')
        body = self._alternatives(0)
        if not scanner.at_end and not scanner.peek("\n\r"):
            offset, found = scanner.offset, scanner.next_character()
            raise GbnfSyntaxError(offset, f"character {found!r}", "it can't stand here", "delete or quote it")
        if name in self.rules:
            message = "it is defined twice, and llama.cpp would silently take the last"
            raise GbnfSyntaxError(begin, f"rule {name}", message, "rename one, or join them by |")
        self.rules[name] = Rule(name, body, position=scanner.position(begin))

    def _alternatives(self, depth: int) -> Expression:
        scanner, begin = self._scanner, self._scanner.offset
        alternatives = [self._sequence(depth)]
        while scanner.peek("|"):
            bar = scanner.offset
            scanner.offset += 1
            scanner.skip_space(newlines=True)
            if scanner.at_end or scanner.at_rule_head() or scanner.peek(")"):
                message = "no alternative follows it"
                raise GbnfSyntaxError(bar, "trailing |", message, "delete it, or write (...)?")
            alternatives.append(self._sequence(depth))
        return choice(alternatives, scanner.position(begin))

    def _sequence(self, depth: int) -> Expression:
        scanner, begin = self._scanner, self._scanner.offset
        items: list[_Item] = []
        while not scanner.at_end and not scanner.peek("|)\n\r"):
            if scanner.peek("*+?{"):
                self._repeat_last(items)
            else:
                items.append(self._item(depth))
            scanner.skip_space(newlines=depth > 0)
        if not items:
            message = "no element stands here"
            raise GbnfSyntaxError(begin, "empty alternative", message, 'write (...)?, or "" for nothing')
        return sequence((item.expression for item in items), scanner.position(begin))

    def _item(self, depth: int) -> _Item:
        scanner = self._scanner
        position = scanner.position(scanner.offset)
        if scanner.peek('"'):
            return _Item(Literal(scanner.string(), position=position))
        if scanner.peek("["):
            return _Item(scanner.char_class())
        if scanner.peek("("):
            return self._group(depth + 1)
        if scanner.peek("."):
            scanner.offset += 1
            return _Item(CharSet(((0, MAX_CODE_POINT),), position=position))
        name = scanner.name()
        self._names.add(name)
        return _Item(Reference(name, position=position))

    def _group(self, depth: int) -> _Item:
        scanner, begin = self._scanner, self._scanner.offset
        if depth > MAX_NESTING:
            message = f"it is nested more than {MAX_NESTING} deep"
            raise GbnfSyntaxError(begin, "group", message, "give the inner groups names")
        scanner.offset += 1
        scanner.skip_space(newlines=True)
        before = self._count()
        self._generated += 1
        inner = self._alternatives(depth)
        if not scanner.peek(")"):
            raise GbnfSyntaxError(begin, "group", "its parenthesis isn't closed", "write )")
        scanner.offset += 1
        return _Item(inner, self._count() - before)

    def _count(self) -> int:
        return len(self._names) + self._generated

    def _repeat_last(self, items: list[_Item]) -> None:
        begin = self._scanner.offset
        low, high = self._bounds()
        if not items or items[-1].expression == Literal(""):
            raise GbnfSyntaxError(begin, "repetition", "nothing stands before it", "write what is repeated")
        last = items[-1]
        rules = last.weight * (high or low or 1)
        if max(rules, low) > MAX_REPETITIONS:
            message = f"it makes {rules} rules; llama.cpp allows {MAX_REPETITIONS}"
            raise GbnfSyntaxError(begin, "repetition", message, "lower the bounds, or leave the upper one out")
        self._generated += 1 if high is None else high - low
        repeat = Repeat(last.expression, low, high, position=self._scanner.position(begin))
        items[-1] = _Item(repeat, rules)

    def _bounds(self) -> tuple[int, int | None]:
        scanner, begin = self._scanner, self._scanner.offset
        if not scanner.peek("{"):
            return _SIGNS[scanner.next_character()]
        match = scanner.take(_BOUNDS)
        if match is None:
            raise GbnfSyntaxError(begin, "repetition", "its bounds can't be read", "write {m}, {m,} or {m,n}")
        low = int(match[1])
        high = int(match[3]) if match[3] else (None if match[2] else low)
        if high is not None and high < low:
            raise GbnfSyntaxError(begin, "repetition", f"no number lies from {low} to {high}", "swap the bounds")
        return low, high
