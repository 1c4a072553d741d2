"""What to write instead of a word that isn't known: one rule for programs, settings and files."""

from collections.abc import Sequence
from difflib import get_close_matches


def suggest(word: str, known: Sequence[str]) -> str:
    """What to write instead of a misspelt word: the nearest known one, or all of them."""
    if word.strip() in known:
        return "remove the white space around the word"
    folded = {name.lower(): name for name in known}
    near = get_close_matches(word.lower(), folded, n=1, cutoff=0.6)
    if near:
        return f"did you mean `{folded[near[0]]}`?"
    return f"one of {', '.join(known)}" if known else "it takes no parameters"
