"""Keeps what is meant for testing out of what is meant for training."""

import re
import unicodedata
from collections.abc import Iterable, Sequence

from rapidfuzz import fuzz, process

# Two normal forms are nearly equal from this share of common characters on (normalised indel similarity, in percent).
NEARLY_EQUAL = 90.0

_POLITE = frozenset(
    {"please", "thanks", "thank", "you", "um", "uh", "er", "hey", "hi", "okay", "ok", "so", "well", "now"}
)


def normal_form(instruction: str) -> str:
    """An instruction without case, accents, punctuation, spacing and words of courtesy."""
    plain = unicodedata.normalize("NFKD", instruction).encode("ascii", "ignore").decode().lower().replace("'", "")
    words = re.findall(r"[a-z0-9.]*[a-z0-9]", plain.replace("-", " "))
    return " ".join([word for word in words if word not in _POLITE] or words)


def leaks(training: Sequence[str], held_out: Iterable[str]) -> dict[int, str]:
    """Finds training instructions that equal or nearly equal a held-out one.

    Args:
        training: Instructions to train on.
        held_out: Instructions of test and development sets.

    Returns:
        For the index of each such training instruction, the held-out instruction that it is too near to.
    """
    tests = {normal_form(instruction): instruction for instruction in held_out}
    tests.pop("", None)
    forms = list(tests)
    found: dict[int, str] = {}
    for index, instruction in enumerate(training):
        form = normal_form(instruction)
        near = form if form in tests else _nearest(form, forms)
        if near is not None:
            found[index] = tests[near]
    return found


def _nearest(form: str, forms: Sequence[str]) -> str | None:
    match = process.extractOne(form, forms, scorer=fuzz.ratio, score_cutoff=NEARLY_EQUAL)
    return None if match is None else match[0]
