"""Sentences about places, moved to other maps."""

import re
from collections.abc import Sequence
from random import Random

_PLACE_LINE = re.compile(r"(?m)^(    value: )(.+)$")


def mentioned(places: Sequence[str], sentence: str) -> list[str]:
    """The places that a sentence names as the map spells them, in any case."""
    return [place for place in places if _pattern(place).search(sentence)]


def in_program(places: Sequence[str], program: str) -> list[str]:
    """The places that a program names."""
    return [match[2] for match in _PLACE_LINE.finditer(program) if match[2] in places]


def is_movable(places: Sequence[str], sentence: str, program: str) -> bool:
    """Whether a sentence stays true on another map once its places are replaced.

    That is so where it names the places of its program, each by its full name and once, and no further one.
    """
    said = mentioned(places, sentence)
    return set(said) == set(in_program(places, program)) and all(
        len(_pattern(place).findall(sentence)) == 1 for place in said
    )


def move(places: Sequence[str], new_map: Sequence[str], sentence: str, program: str, rng: Random) -> tuple[str, str]:
    """Replaces the places of a movable sentence and of its program by others of the new map."""
    said = mentioned(places, sentence)
    chosen = dict(zip(said, rng.sample(list(new_map), len(said)), strict=True))
    if chosen:
        found = re.compile("|".join(_pattern(place).pattern for place in sorted(said, key=len, reverse=True)), re.I)
        by_form = {place.lower(): new for place, new in chosen.items()}
        sentence = found.sub(lambda match: _as_said(by_form[match[0].lower()], match[0]), sentence)
        program = _PLACE_LINE.sub(lambda match: match[1] + chosen.get(match[2], match[2]), program)
    return sentence, program


def replace_name(place: str, words: str, sentence: str) -> str:
    """Puts other words in the stead of a place's name and of the article before it."""
    return re.sub(rf"(?:\b(?:the|a|an|my)\s+)?{_pattern(place).pattern}", lambda _: words, sentence, flags=re.I)


def is_free_of(names: Sequence[str], sentence: str) -> bool:
    """Whether a sentence has no word in common with any of the names, but for small ones."""
    words = {word for name in names for word in re.findall(r"[a-z]{3,}", name.lower())} - {"the", "and"}
    return words.isdisjoint(re.findall(r"[a-z]{3,}", sentence.lower()))


def random_map(names: Sequence[str], rng: Random) -> tuple[str, ...]:
    """The places of an invented map: 3 to 14 names."""
    return tuple(rng.sample(list(names), rng.randint(3, 14)))


def _pattern(place: str) -> re.Pattern[str]:
    return re.compile(rf"(?<![\w-]){re.escape(place)}(?![\w-])", re.IGNORECASE)


def _as_said(place: str, like: str) -> str:
    """The name in small letters where the one that it replaces was."""
    return place.lower() if like == like.lower() else place
