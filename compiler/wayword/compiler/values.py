"""Reads one value by its type: numbers with units and bounds, words, places."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal

from wayword.compiler.diagnostics import (
    MALFORMED_PLACE,
    NOT_A_NUMBER,
    OUT_OF_BOUNDS,
    UNKNOWN_PLACE,
    UNKNOWN_UNIT,
    UNKNOWN_WORD,
    WRONG_DIMENSION,
    WRONG_SIGN,
    Code,
)
from wayword.compiler.suggestions import suggest
from wayword.compiler.syntax import Measurement, Value, Word
from wayword.compiler.units import UNITS, Unit
from wayword.compiler.vocabulary import Choice, DrivingParameter, Quantity, ValueType

DEFAULT = "default"
STEPS = ("increase", "decrease")

# No leading zeros: a YAML 1.1 reader takes 0100 for an octal number.
_NUMBER = re.compile(r"(?P<sign>[+-]?)(?P<number>(?:0|[1-9][0-9]{0,3})(?:\.[0-9]{1,3})?)(?: (?P<unit>\S.*))?")
_PLACE = re.compile(r"(?=.{1,40}\Z)[A-Za-z][A-Za-z0-9.'-]*(?: [A-Za-z0-9.'-]+)*")
# What a YAML 1.1 reader doesn't take for a string, and the language's own word.
_RESERVED = frozenset({"y", "n", "yes", "no", "on", "off", "true", "false", "null", DEFAULT})


def is_place_name(text: str) -> bool:
    """Whether a text can be the name of a place (language.md section 2), on whatever map."""
    return _PLACE.fullmatch(text) is not None and text.lower() not in _RESERVED


@dataclass(frozen=True, slots=True)
class Problem:
    """Why a value could not be read."""

    code: Code
    message: str
    help: str | None = None


def read_value(name: str, kind: ValueType, text: str, places: Sequence[str] | None) -> Value | Problem:
    """Reads the value of an action's own parameter.

    Args:
        name: The parameter, for messages.
        kind: Its type.
        text: The value as written.
        places: Names on the loaded map; None accepts any well-formed name.
    """
    if isinstance(kind, Choice):
        return _read_word(name, kind.options, text)
    if isinstance(kind, Quantity):
        return _read_quantity(name, kind, text)
    return _read_place(text, places)


def read_setting(parameter: DrivingParameter, text: str) -> Value | Problem:
    """Reads what SET_PARAM sets: a value of the parameter's type, or ``default``."""
    if text == DEFAULT:
        return Word(DEFAULT)
    if isinstance(parameter.type, Choice):
        return _read_word(parameter.name, (*parameter.type.options, DEFAULT), text)
    return _read_quantity(parameter.name, parameter.type, text)


def read_delta(name: str, kind: Quantity, text: str) -> Value | Problem:
    """Reads what ADJUST_PARAM changes: ``increase``, ``decrease`` or a signed delta, which has no bounds."""
    if text in STEPS:
        return Word(text)
    return _read_measurement(name, kind, text, signed=True)


def _read_word(name: str, options: Sequence[str], text: str) -> Value | Problem:
    if text in options:
        return Word(text)
    hint = f"one of {', '.join(options)}"
    if text.strip("'\"") in options:
        hint = "leave out the quotation marks"
    return Problem(UNKNOWN_WORD, f"{name} can't be `{text}`", hint)


def _read_place(text: str, places: Sequence[str] | None) -> Value | Problem:
    if not is_place_name(text):
        return Problem(MALFORMED_PLACE, f"`{text}` is no name of a place", MALFORMED_PLACE.explanation)
    if places is None or text in places:
        return Word(text)
    return Problem(UNKNOWN_PLACE, f"the map has no place `{text}`", suggest(text, places))


def _read_quantity(name: str, kind: Quantity, text: str) -> Value | Problem:
    value = _read_measurement(name, kind, text, signed=False)
    if isinstance(value, Problem):
        return value
    bounds = kind.bounds_of(value.unit.dimension)
    if bounds is not None and not bounds.contains(value.si):
        return Problem(OUT_OF_BOUNDS, f"{name} is out of bounds: {value}", f"{bounds} are allowed")
    return value


def _read_measurement(name: str, kind: Quantity, text: str, *, signed: bool) -> Measurement | Problem:
    match = _NUMBER.fullmatch(text)
    if match is None:
        example = f"+10 {kind.default_unit}" if signed else str(kind.bounds[0].upper)
        return Problem(NOT_A_NUMBER, f"`{text}` is no {' or '.join(kind.dimensions)}", f"write it like `{example}`")
    if bool(match["sign"]) != signed:
        wanted = "a sign is needed: `+` or `-`" if signed else "leave out the sign"
        return Problem(WRONG_SIGN, f"the sign of `{text}` is {'missing' if signed else 'not allowed'}", wanted)
    unit = _read_unit(name, kind, match["unit"])
    if isinstance(unit, Problem):
        return unit
    return Measurement(Decimal(match["sign"] + match["number"]), unit, signed)


def _read_unit(name: str, kind: Quantity, text: str | None) -> Unit | Problem:
    if text is None:
        return UNITS[kind.default_unit]
    unit = UNITS.get(text)
    allowed = f"units of {name}: {', '.join(kind.units)}"
    if unit is None:
        return Problem(UNKNOWN_UNIT, f"`{text}` is no unit", allowed)
    if unit.dimension not in kind.dimensions:
        wanted = " or ".join(kind.dimensions)
        return Problem(WRONG_DIMENSION, f"{name} is a {wanted}, but {text} is a unit of {unit.dimension}", allowed)
    return unit
