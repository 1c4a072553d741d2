"""Passes that keep the language and make a grammar smaller, or cheaper for an engine to run."""

from collections import Counter
from dataclasses import replace
from itertools import groupby

from wayword.grammar.ir import (
    CharSet,
    Choice,
    Expression,
    Grammar,
    Literal,
    Reference,
    Rule,
    Sequence,
    char_set,
    choice,
    references,
    rewrite,
    sequence,
)
from wayword.grammar.trie import trie

MIN_FACTORED = 4
"""Choices of fewer literals than this stay as they are: a trie costs the reader more than it saves."""


def simplify(grammar: Grammar) -> Grammar:
    """Run all passes: inline trivial rules, join literals, factor choices, drop what isn't reached."""
    grammar = inline_trivial(grammar)
    for visit in (_join_literals, _factor, _join_characters):
        grammar = grammar.with_rules(replace(rule, body=rewrite(rule.body, visit)) for rule in grammar.rules.values())
    return reachable(grammar)


def reachable(grammar: Grammar) -> Grammar:
    """Keep only the rules which the start rule reaches, in the order in which it reaches them."""
    pending = [grammar.start]
    reached: dict[str, Rule] = {}
    for name in pending:
        if name in grammar.rules and name not in reached:
            reached[name] = rule = grammar.rules[name]
            pending.extend(reference.name for reference in references(rule.body))
    return grammar.with_rules(reached.values())


def inline_trivial(grammar: Grammar) -> Grammar:
    """Put the bodies of trivial rules in the place of their names, until none is left."""
    while True:
        names = _trivial_rules(grammar)
        inlined = reachable(grammar.with_rules(_inline(rule, grammar, names) for rule in grammar.rules.values()))
        if inlined == grammar:
            return grammar
        grammar = inlined


def _trivial_rules(grammar: Grammar) -> set[str]:
    """Return the rules that are one literal, set or name, and those marked ``_`` (inline) that are used once.

    A choice keeps its name: in the middle of another rule it would make a long and unreadable line.
    """
    uses = Counter(each.name for rule in grammar.rules.values() for each in references(rule.body))
    return {
        name
        for name, rule in grammar.rules.items()
        if name != grammar.start
        and (isinstance(rule.body, Literal | CharSet | Reference) or (_is_inline(rule) and uses[name] == 1))
    }


def _is_inline(rule: Rule) -> bool:
    return rule.name.startswith("_") and not rule.is_terminal and not isinstance(rule.body, Choice)


def _inline(rule: Rule, grammar: Grammar, names: set[str], *enclosing: str) -> Rule:
    """Inline into one rule; what refers back to an enclosing rule stays a reference."""
    enclosing = (rule.name, *enclosing)

    def visit(expression: Expression) -> Expression:
        match expression:
            case Reference(name) if name in names and name not in enclosing:
                return _inline(grammar.rules[name], grammar, names, *enclosing).body
        return expression

    return replace(rule, body=rewrite(rule.body, visit))


def _join_literals(expression: Expression) -> Expression:
    """Join literals that follow each other."""
    if not isinstance(expression, Sequence):
        return expression
    joined: list[Expression] = []
    for is_literal, run in groupby(expression.items, key=lambda item: isinstance(item, Literal)):
        items = list(run)
        if is_literal:
            text = "".join(item.text for item in items if isinstance(item, Literal))
            items = [Literal(text, position=items[0].position)] if text else []
        joined.extend(items)
    return sequence(joined, expression.position)


def _factor(expression: Expression) -> Expression:
    """Factor the literals of a long choice; its other alternatives follow them."""
    if not isinstance(expression, Choice):
        return expression
    words = [each.text for each in expression.alternatives if isinstance(each, Literal)]
    if len(words) < MIN_FACTORED:
        return expression
    others = [each for each in expression.alternatives if not isinstance(each, Literal)]
    return choice([trie(words), *others], expression.position)


def _join_characters(expression: Expression) -> Expression:
    """Join alternatives of one character each into one set, in the place of the first."""
    if not isinstance(expression, Choice):
        return expression
    sets = [each for each in expression.alternatives if _ranges(each)]
    if len(sets) < 2:
        return expression
    joined = char_set((span for each in sets for span in _ranges(each)), sets[0].position)
    rest = [joined if each is sets[0] else each for each in expression.alternatives]
    return choice((each for each in rest if each is joined or not _ranges(each)), expression.position)


def _ranges(expression: Expression) -> tuple[tuple[int, int], ...]:
    match expression:
        case CharSet(ranges):
            return ranges
        case Literal(text) if len(text) == 1:
            return ((ord(text), ord(text)),)
    return ()
