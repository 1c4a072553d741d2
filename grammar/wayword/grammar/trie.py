"""Factors alternatives by their common prefixes, so that an engine follows one path where there were many."""

from collections.abc import Iterable

from wayword.grammar.ir import Expression, Literal, Repeat, choice, sequence


def trie(words: Iterable[str]) -> Expression:
    """Return an expression for exactly these words in which no two alternatives begin alike.

    The order is that of the first word with each beginning, so that the same words give the same expression.
    """
    distinct = dict.fromkeys(words)
    endings = [word for word in distinct if word]
    if not endings:
        return Literal("")
    branches = choice(_branch(group) for group in _by_first_character(endings))
    return Repeat(branches, 0, 1) if "" in distinct else branches


def _by_first_character(words: Iterable[str]) -> Iterable[list[str]]:
    groups: dict[str, list[str]] = {}
    for word in words:
        groups.setdefault(word[0], []).append(word)
    return groups.values()


def _branch(words: list[str]) -> Expression:
    if len(words) == 1:
        return Literal(words[0])
    prefix = _common_prefix(words)
    return sequence([Literal(prefix), trie(word[len(prefix) :] for word in words)])


def _common_prefix(words: list[str]) -> str:
    first, last = min(words), max(words)  # All others lie between them and share what these two share.
    shared = 0
    while shared < len(first) and first[shared] == last[shared]:
        shared += 1
    return first[:shared]
