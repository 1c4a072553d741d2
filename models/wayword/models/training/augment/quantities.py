"""Other values and units for the quantities in a sentence and its program."""

import re
from dataclasses import dataclass
from random import Random

from wayword.models.training.augment.numbers import Mention, find_numbers, find_ordinals, say, say_ordinal

# How units are said and written, the commonest first.
UNIT_PHRASES = {
    "km/h": (
        "km/h",
        "kmh",
        "kph",
        "kilometers per hour",
        "kilometres per hour",
        "kilometers an hour",
        "kilometres an hour",
        "k p h",
        "kilometer per hour",
    ),
    "mph": ("mph", "miles per hour", "miles an hour", "m p h", "mile per hour"),
    "m/s": (
        "m/s",
        "meters per second",
        "metres per second",
        "meters a second",
        "metres a second",
        "mps",
        "meter per second",
    ),
    "m": ("m", "meters", "metres", "meter", "metre"),
    "ft": ("ft", "feet", "foot"),
    "s": ("s", "seconds", "second", "sec", "secs"),
    "m/s^2": (
        "m/s^2",
        "m/s²",
        "meters per second squared",
        "metres per second squared",
        "m/s2",
        "meters per square second",
        "meter per second squared",
    ),
}
_SPEED_UNITS = ("km/h", "mph", "m/s")
_LENGTH_UNITS = ("m", "ft")

# (parameter, unit) to (lowest, highest, usual step) of a value, and of a delta. Some lie outside the language's bounds:
# the model translates, it does not judge (language.md section 4, rule 1).
_VALUES = {
    ("max_vel", "km/h"): (5, 160, 5),
    ("max_vel", "mph"): (5, 95, 5),
    ("max_vel", "m/s"): (2, 45, 1),
    ("following_distance", "s"): (1, 5, 0.5),
    ("following_distance", "m"): (5, 120, 5),
    ("following_distance", "ft"): (15, 400, 5),
    ("min_gap", "m"): (1.5, 10, 0.5),
    ("min_gap", "ft"): (4, 35, 1),
    ("max_accel", "m/s^2"): (0.3, 3.4, 0.1),
    ("max_decel", "m/s^2"): (1, 4.5, 0.1),
    ("max_lat_accel", "m/s^2"): (0.4, 3.4, 0.1),
    ("limit", "km/h"): (10, 130, 10),
    ("limit", "mph"): (5, 80, 5),
    ("limit", "m/s"): (5, 36, 1),
    ("distance", "m"): (1, 200, 5),
    ("distance", "ft"): (5, 600, 5),
}
_DELTAS = {
    ("max_vel", "km/h"): (1, 40, 5),
    ("max_vel", "mph"): (1, 30, 5),
    ("max_vel", "m/s"): (1, 15, 1),
    ("following_distance", "s"): (0.1, 2.5, 0.5),
    ("following_distance", "m"): (1, 50, 5),
    ("following_distance", "ft"): (5, 150, 5),
    ("min_gap", "m"): (0.5, 5, 0.5),
    ("min_gap", "ft"): (1, 15, 1),
    ("max_accel", "m/s^2"): (0.1, 1.5, 0.1),
    ("max_decel", "m/s^2"): (0.1, 1.5, 0.1),
    ("max_lat_accel", "m/s^2"): (0.1, 1.5, 0.1),
}
_QUANTITY = re.compile(
    r"  - name: (?P<name>\w+)\n    value: (?P<sign>[+-]?)(?P<number>\d+(?:\.\d+)?)(?: (?P<unit>\S+))?\n"
)

# Words that a number of an exit follows.
_COUNTER = re.compile(r"\b(?:exit|number|no\.?|ramp|junction|turning)\s$", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class _Edit:
    start: int
    end: int
    text: str


def vary_quantities(sentence: str, program: str, rng: Random) -> tuple[str, str]:
    """Replaces the numbers, and some units, of a program and of the sentence that it came from.

    A quantity is replaced only where exactly one number of the sentence is its number; others, such as half a second
    or a value that was computed, stay.
    """
    quantities = list(_QUANTITY.finditer(program))
    numbers = [float(quantity["number"]) for quantity in quantities]
    in_sentence, in_program = [], []
    for quantity, number in zip(quantities, numbers, strict=True):
        cardinal = quantity["unit"] is not None
        mentions = find_numbers(sentence) + ([] if cardinal else find_ordinals(sentence))
        matching = [mention for mention in mentions if abs(mention.value - number) < 1e-9]
        if len(matching) != 1 or numbers.count(number) != 1:
            continue
        others = {mention.value for mention in mentions if mention is not matching[0]}
        edit = _exit_edit if not cardinal else _quantity_edit
        pair = edit(sentence, quantity, matching[0], others, rng)
        if pair is not None:
            in_sentence.append(pair[0])
            in_program.append(pair[1])
    return _apply(sentence, in_sentence), _apply(program, in_program)


def _exit_edit(
    sentence: str, quantity: re.Match[str], mention: Mention, others: set[float], rng: Random
) -> tuple[_Edit, _Edit] | None:
    number = rng.randint(1, 5)
    if number in others or _is_pronoun(sentence, mention):
        return None
    said = say_ordinal(number, rng) if mention.ordinal else say(number, rng, words=rng.random() < 0.5)
    return _Edit(mention.start, mention.end, said), _Edit(*quantity.span("number"), str(number))


def _is_pronoun(sentence: str, mention: Mention) -> bool:
    """Whether it is the "one" of "the next one", not of "exit one"."""
    said = sentence[mention.start : mention.end].lower()
    return said == "one" and not _COUNTER.search(sentence, 0, mention.start)


def _quantity_edit(
    sentence: str, quantity: re.Match[str], mention: Mention, others: set[float], rng: Random
) -> tuple[_Edit, _Edit] | None:
    name, unit = quantity["name"], quantity["unit"]
    ranges = _DELTAS if quantity["sign"] else _VALUES
    phrase = _unit_phrase(sentence, mention.end, unit)
    end = mention.end
    said_unit = ""
    if phrase is not None:
        end = phrase.end()
        said_unit = phrase[0]
        if rng.random() < 0.4:
            unit = rng.choice([u for n, u in ranges if n == name and (u in _same_kind(unit))])
            said_unit = f" {_choose_phrase(unit, rng)}"
    if (name, unit) not in ranges:
        return None
    value = _draw(*ranges[name, unit], rng)
    if value in others:
        return None
    words = (sentence[mention.start].isalpha()) ^ (rng.random() < 0.35)
    said = say(value, rng, words=words)
    if words and said_unit:  # "60mph" and "2-second" in words
        said_unit = f" {said_unit.lstrip(' -')}"
    return (
        _Edit(mention.start, end, said + said_unit),
        _Edit(quantity.start("number"), quantity.end("unit"), f"{value:g} {unit}"),
    )


def _same_kind(unit: str) -> tuple[str, ...]:
    return next((kind for kind in (_SPEED_UNITS, _LENGTH_UNITS) if unit in kind), (unit,))


def _unit_phrase(sentence: str, position: int, unit: str) -> re.Match[str] | None:
    said = "|".join(re.escape(phrase) for phrase in sorted(UNIT_PHRASES[unit], key=len, reverse=True))
    return re.compile(rf"[ -]?(?:{said})(?![\w/^²])", re.IGNORECASE).match(sentence, position)


def _choose_phrase(unit: str, rng: Random) -> str:
    phrases = UNIT_PHRASES[unit]
    return phrases[min(int(rng.expovariate(0.6)), len(phrases) - 1)]


def _draw(lowest: float, highest: float, step: float, rng: Random) -> float:
    """A value, mostly a multiple of the usual step, else of its fifth (or of 0.1)."""
    if rng.random() < 0.3:
        step = max(step / 5, 0.1) if step != 1 else rng.choice((1, 0.5))
    value = round(rng.uniform(lowest, highest) / step) * step
    return round(max(value, step), 1)


def _apply(text: str, edits: list[_Edit]) -> str:
    for edit in sorted(edits, key=lambda edit: edit.start, reverse=True):
        text = text[: edit.start] + edit.text + text[edit.end :]
    return text
