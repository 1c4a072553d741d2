"""Checks GBNF text before native code sees it: llama.cpp answers a bad grammar with a crash or a hang."""

from collections.abc import Iterator
from graphlib import TopologicalSorter

from wayword.grammar.analysis import (
    Rules,
    left_corners,
    left_recursions,
    nullable_repetitions,
    nullable_rules,
    undefined_references,
    unproductive_rules,
)
from wayword.grammar.diagnostics import Diagnostic, GrammarError, Position
from wayword.grammar.gbnf_parser import GbnfParser

ROOT = "root"
"""The name of the rule from which every engine starts."""
MAX_LEFT_CORNERS = 1_000_000
"""llama.cpp's search for left recursion follows every path of first elements. More paths take seconds, or
years."""


def check_gbnf(text: str, file: str = "<gbnf>") -> None:
    """Raise `GrammarError` with all that `lint_gbnf` finds, if it finds anything."""
    diagnostics = lint_gbnf(text, file)
    if diagnostics:
        raise GrammarError(diagnostics)


def lint_gbnf(text: str, file: str = "<gbnf>") -> list[Diagnostic]:
    """Return what makes a GBNF text unfit for llama.cpp.

    Args:
        text: The grammar.
        file: What positions name as the file.
    """
    parser = GbnfParser(text, file)
    if parser.diagnostics:  # What the rules would be is unknown, so that further findings would mislead.
        return parser.diagnostics
    missing = [*_missing_root(parser.rules, file), *_undefined(parser.rules)]
    return missing or lint_rules(parser.rules)


def lint_rules(rules: Rules) -> list[Diagnostic]:
    """Return what makes rules, each of them defined, unfit for llama.cpp."""
    diagnostics = [*_left_recursion(rules), *_empty_repetition(rules), *_endless(rules)]
    return diagnostics or list(_too_many_corners(rules))


def _missing_root(rules: Rules, file: str) -> Iterator[Diagnostic]:
    if ROOT not in rules:
        position = Position(file, 1, 1)
        yield Diagnostic(position, f"rule {ROOT}", "there is none to start from", f"add: {ROOT} ::= ...")


def _undefined(rules: Rules) -> Iterator[Diagnostic]:
    for rule, reference in undefined_references(rules):
        message = f"{rule.name} refers to it, but it isn't defined"
        yield Diagnostic(reference.position, f"rule {reference.name}", message, "define it")


def _left_recursion(rules: Rules) -> Iterator[Diagnostic]:
    for cycle in left_recursions(rules):
        message = "it can begin with itself: " + " -> ".join((*cycle, cycle[0]))
        way_out = "write it as a repetition, or let it refer to itself only at its end"
        yield Diagnostic(rules[cycle[0]].position, f"left recursion in {cycle[0]}", message, way_out)


def _empty_repetition(rules: Rules) -> Iterator[Diagnostic]:
    for rule, repeat in nullable_repetitions(rules):
        message = "what it repeats without a bound may be empty, so that nothing is repeated for ever"
        position = repeat.position or rule.position
        yield Diagnostic(position, f"repetition in {rule.name}", message, "let it repeat at least one character")


def _endless(rules: Rules) -> Iterator[Diagnostic]:
    for rule in unproductive_rules(rules):
        message = "it derives no finite text, so that a model could never end"
        way_out = "add an alternative without the recursion"
        yield Diagnostic(rule.position, f"rule {rule.name}", message, way_out)


def _too_many_corners(rules: Rules) -> Iterator[Diagnostic]:
    nullable = nullable_rules(rules)
    corners = {name: list(left_corners(rule.body, nullable)) for name, rule in rules.items()}
    visits: dict[str, int] = {}
    for name in TopologicalSorter(corners).static_order():
        visits[name] = 1 + sum(visits[corner] for corner in corners[name])
        if visits[name] > MAX_LEFT_CORNERS:
            message = f"it begins along more than {MAX_LEFT_CORNERS} paths, each of which llama.cpp follows"
            way_out = "factor what its alternatives begin with"
            yield Diagnostic(rules[name].position, f"rule {name}", message, way_out)
            return
