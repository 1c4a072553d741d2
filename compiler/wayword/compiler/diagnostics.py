"""Diagnostics as data. How they are shown is decided elsewhere (``render.py``)."""

from dataclasses import dataclass
from enum import StrEnum

from wayword.compiler.spans import Span


class Severity(StrEnum):
    """How bad it is."""

    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True, slots=True)
class Code:
    """A kind of diagnostic, declared once.

    Attributes:
        name: ``WW`` and four digits; stable across versions.
        title: What is wrong, in general.
        explanation: Why it is wrong and what to do about it.
    """

    name: str
    title: str
    explanation: str


CODES: dict[str, Code] = {}


def _declare(name: str, title: str, explanation: str) -> Code:
    code = Code(name, title, explanation)
    CODES[name] = code
    return code


# 01: the shape of the program
UNEXPECTED_TEXT = _declare(
    "WW0101",
    "unexpected text",
    "A command has the lines `command_type: …`, `action: …` and, where the action has parameters, `parameters:` "
    "followed by `  - name: …` and `    value: …` for each; commands are separated by a line `---`.",
)
UNEXPECTED_END = _declare(
    "WW0102",
    "unexpected end of the program",
    "The program stops in the middle of a command. Complete the command.",
)
TOO_MANY_COMMANDS = _declare(
    "WW0103", "too many commands", "A program has 1 to 4 commands. Split it into several programs."
)

# 02: names
UNKNOWN_COMMAND_TYPE = _declare(
    "WW0201",
    "unknown command type",
    "The command types are INFORMATION, MISSION, CONFIG, COOPERATION, INTERVENTION and OUT_OF_SCOPE.",
)
UNKNOWN_ACTION = _declare("WW0202", "unknown action", "The language has no action of this name.")
WRONG_COMMAND_TYPE = _declare(
    "WW0203", "action of another command type", "Each action belongs to exactly one command type."
)
UNKNOWN_PARAMETER = _declare("WW0204", "unknown parameter", "The action has no parameter of this name.")
MISSING_PARAMETER = _declare("WW0205", "missing parameter", "The action needs a parameter which isn't given.")
REPEATED_PARAMETER = _declare("WW0206", "parameter given twice", "Each parameter may be given once.")
NOT_ONE_SETTING = _declare(
    "WW0207",
    "more than one setting in a command",
    "SET_PARAM and ADJUST_PARAM take exactly one driving parameter. Use a command for each.",
)

# 03: values
WRONG_DIMENSION = _declare(
    "WW0301",
    "unit of another dimension",
    "The unit measures something else than the parameter. A speed needs km/h, mph or m/s, a time s, a length m or ft, "
    "an acceleration m/s^2.",
)
UNKNOWN_UNIT = _declare(
    "WW0302",
    "unknown unit",
    "The units are km/h, mph and m/s; s; m and ft; m/s^2. One space stands before the unit.",
)
OUT_OF_BOUNDS = _declare(
    "WW0303",
    "value out of bounds",
    "The value lies outside what the parameter allows. A value at a bound is legal.",
)
UNKNOWN_WORD = _declare("WW0304", "not one of the allowed words", "The parameter takes one of a few words.")
NOT_A_NUMBER = _declare(
    "WW0305",
    "not a number",
    "A number is decimal, with at most 4 digits before the point, no leading zeros, and at most 3 after it; then come "
    "one space and the unit.",
)
WRONG_SIGN = _declare(
    "WW0306",
    "sign missing or not allowed",
    "A delta of ADJUST_PARAM needs a sign (`+10 km/h`); no other value may have one.",
)
NOT_ADJUSTABLE = _declare(
    "WW0307",
    "parameter can't be adjusted",
    "ADJUST_PARAM takes numeric parameters. Use SET_PARAM with a word.",
)

# 04: places
UNKNOWN_PLACE = _declare("WW0401", "place not on the map", "The loaded map has no place of this name.")
MALFORMED_PLACE = _declare(
    "WW0402",
    "malformed place name",
    "A place name starts with a letter and has at most 40 letters, digits, dots, apostrophes, hyphens and single "
    "spaces; it is no word that YAML reads as something else than text (yes, no, on, off, true, false, null), and not "
    "`default`.",
)


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """Something to say about a program.

    Attributes:
        code: Which kind.
        span: Where.
        message: What is wrong here.
        help: What to do about it.
        severity: Errors keep a program from being lowered.
    """

    code: Code
    span: Span
    message: str
    help: str | None = None
    severity: Severity = Severity.ERROR

    def to_json(self) -> dict[str, str | int | None]:
        """The form that ``--json`` prints."""
        return {
            "code": self.code.name,
            "severity": self.severity.value,
            "line": self.span.line,
            "column": self.span.column,
            "end_column": self.span.end_column,
            "message": self.message,
            "help": self.help,
        }
