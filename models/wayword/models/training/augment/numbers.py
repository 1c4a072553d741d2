"""Numbers in English sentences: where they are, and how they may be said."""

import re
from dataclasses import dataclass
from random import Random

_UNITS = (
    "zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve",
    "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen",
)  # fmt: skip
_TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
_ORDINALS = ("first", "second", "third", "fourth", "fifth")
_ORDINAL_DIGITS = ("1st", "2nd", "3rd", "4th", "5th")

_SMALL = {word: value for value, word in enumerate(_UNITS)}
_TEN = {word: 10 * (index + 2) for index, word in enumerate(_TENS)}

_ten_unit = rf"(?:{'|'.join(_TENS)})(?:[ -](?:{'|'.join(_UNITS[1:10])}))?"
_below_100 = rf"(?:{_ten_unit}|{'|'.join(sorted(_UNITS, key=len, reverse=True))})"
_hundreds = rf"(?:(?:a|{'|'.join(_UNITS[1:10])}) )?hundred(?:(?: and)? {_below_100})?"
_short_hundreds = rf"(?:one|two|three) (?:{_ten_unit}|{'|'.join(_UNITS[10:])})"  # "one twenty"
_whole = rf"(?:{_hundreds}|{_short_hundreds}|{_below_100})"
_NUMBER = re.compile(
    rf"(?<![\w.,^-])(?:(?P<digits>\d+(?:\.\d+)?)(?=(?:km|mph|m|ft|s)?(?![\w])(?!\.\d))"
    rf"|(?P<words>{_whole}(?: point(?: (?:{'|'.join(_UNITS[:10])}))+| and a half)?)(?![\w-]))",
    re.IGNORECASE,
)
_ORDINAL = re.compile(rf"\b(?:{'|'.join(_ORDINALS)}|{'|'.join(_ORDINAL_DIGITS)})\b", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Mention:
    """A number in a sentence.

    Attributes:
        start: Where it begins.
        end: Where it ends.
        value: The number.
        ordinal: Whether it is "third" rather than "three".
    """

    start: int
    end: int
    value: float
    ordinal: bool = False


def find_numbers(sentence: str) -> list[Mention]:
    """Finds cardinal numbers, in digits or words."""
    return [
        Mention(match.start(), match.end(), float(match["digits"]) if match["digits"] else _value(match["words"]))
        for match in _NUMBER.finditer(sentence)
    ]


def find_ordinals(sentence: str) -> list[Mention]:
    """Finds "first" to "fifth" and "1st" to "5th"."""
    return [
        Mention(match.start(), match.end(), float(_ordinal_value(match[0].lower())), ordinal=True)
        for match in _ORDINAL.finditer(sentence)
    ]


def say(value: float, rng: Random, *, words: bool) -> str:
    """Says a number below 1,000 with at most one decimal, in one of the usual ways."""
    whole, tenth = divmod(round(value * 10), 10)
    if not words:
        return f"{value:g}"
    if tenth == 0:
        return _say_whole(whole, rng)
    if tenth == 5 and whole and rng.random() < 0.4:
        return f"{_say_whole(whole, rng)} and a half"
    return f"{_say_whole(whole, rng)} point {_UNITS[tenth]}"


def say_ordinal(value: int, rng: Random) -> str:
    """Says "third" or "3rd"."""
    return (_ORDINALS if rng.random() < 0.8 else _ORDINAL_DIGITS)[value - 1]


def _say_whole(value: int, rng: Random) -> str:
    hundreds, rest = divmod(value, 100)
    if not hundreds:
        return _below_hundred(rest, rng)
    if rest >= 10 and hundreds <= 3 and rng.random() < 0.3:
        return f"{_UNITS[hundreds]} {_below_hundred(rest, rng)}"
    start = "a hundred" if hundreds == 1 and rng.random() < 0.4 else f"{_UNITS[hundreds]} hundred"
    joint = " and " if rng.random() < 0.6 else " "
    return start + (f"{joint}{_below_hundred(rest, rng)}" if rest else "")


def _below_hundred(value: int, rng: Random) -> str:
    if value < 20:
        return _UNITS[value]
    tens, unit = divmod(value, 10)
    return _TENS[tens - 2] + (f"{rng.choice('- ')}{_UNITS[unit]}" if unit else "")


def _value(words: str) -> float:
    words = words.lower().replace("-", " ")
    half = 0.5 if words.endswith(" and a half") else 0.0
    whole, _, decimals = words.removesuffix(" and a half").partition(" point ")
    fraction = float("0." + "".join(str(_SMALL[word]) for word in decimals.split())) if decimals else half
    return _whole_value(whole.split()) + fraction


def _whole_value(words: list[str]) -> int:
    if "hundred" in words:
        split = words.index("hundred")
        hundreds = _SMALL.get(words[0], 1) if split else 1
        return 100 * hundreds + _whole_value([word for word in words[split + 1 :] if word != "and"])
    if len(words) > 1 and words[0] in _SMALL:  # "one twenty"
        return 100 * _SMALL[words[0]] + _whole_value(words[1:])
    return sum(_TEN.get(word, _SMALL.get(word, 0)) for word in words)


def _ordinal_value(word: str) -> int:
    return (_ORDINALS if word in _ORDINALS else _ORDINAL_DIGITS).index(word) + 1
