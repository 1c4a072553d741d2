"""Narrows a grammar to what is true now: a terminal for an open class becomes the names that exist."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from wayword.grammar.diagnostics import Diagnostic, GrammarError
from wayword.grammar.ir import Grammar, Rule
from wayword.grammar.recognise import matches
from wayword.grammar.trie import trie


def specialise(grammar: Grammar, names: Mapping[str, Sequence[str]]) -> Grammar:
    """Replace terminals by choices of names.

    Args:
        grammar: A grammar whose terminals still stand for themselves, as a loader gives it.
        names: For each terminal the names that shall take its stead. The terminal must match each, so that
            whatever the narrowed grammar derives, the wide one does.

    Raises:
        GrammarError: A terminal is unknown, or its names are none, twice the same, or not what it matches.
    """
    diagnostics = [each for terminal in names for each in _problems(grammar, terminal, names[terminal])]
    if diagnostics:
        raise GrammarError(diagnostics)
    rules = dict(grammar.rules)
    for terminal, words in names.items():
        rules[terminal] = replace(rules[terminal], body=trie(words))
    remarks = (f"{terminal}: one of {len(words)} names" for terminal, words in names.items())
    return replace(grammar, rules=rules, provenance=(*grammar.provenance, *remarks))


def _problems(grammar: Grammar, terminal: str, words: Sequence[str]) -> Iterator[Diagnostic]:
    rule = grammar.rules.get(terminal)
    construct = f"specialisation of {terminal}"
    if rule is None or not rule.is_terminal:
        known = ", ".join(name for name, each in grammar.rules.items() if each.is_terminal)
        yield Diagnostic(None, construct, "the grammar has no such terminal", f"name one of: {known}")
        return
    if not words:
        message = "with no names nothing could stand in its place"
        yield Diagnostic(rule.position, construct, message, "give at least one name")
    for word in (word for word, times in Counter(words).items() if times > 1):
        yield Diagnostic(rule.position, construct, f"{word!r} is named twice", "name it once")
    for word in words:
        if not _is_well_formed(grammar, rule, word):
            message = f"{word!r} is not what the terminal matches"
            yield Diagnostic(rule.position, construct, message, "rename it, or widen the terminal")


def _is_well_formed(grammar: Grammar, terminal: Rule, word: str) -> bool:
    return matches(grammar.rules, terminal.body, word)
