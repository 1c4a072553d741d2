"""The two trees of a program: as it was written, and as it was understood.

Spans are kept for diagnostics and left out of equality.
"""

from dataclasses import dataclass, field
from decimal import Decimal

from wayword.compiler.spans import Span
from wayword.compiler.units import Unit
from wayword.compiler.vocabulary import Action


# --- as written ---------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Written:
    """A word or value as it stands in the text."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class WrittenParameter:
    """A ``name`` and ``value`` pair."""

    name: Written
    value: Written


@dataclass(frozen=True, slots=True)
class WrittenCommand:
    """One document of the program."""

    command_type: Written
    action: Written
    parameters: tuple[WrittenParameter, ...]


# --- as understood ------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Word:
    """One of a parameter's words, or the name of a place."""

    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True, slots=True)
class Measurement:
    """A number with its unit; `signed` marks a delta, which is printed with its sign."""

    number: Decimal
    unit: Unit
    signed: bool = False

    @property
    def si(self) -> float:
        """The value in SI units."""
        return float(self.number) * self.unit.to_si

    def __str__(self) -> str:
        number = f"{self.number:+f}" if self.signed else f"{self.number:f}"
        if "." in number:
            number = number.rstrip("0").rstrip(".")
        return f"{number} {self.unit.name}"


Value = Word | Measurement


@dataclass(frozen=True, slots=True)
class Argument:
    """A parameter's name with its value."""

    name: str
    value: Value


@dataclass(frozen=True, slots=True)
class Command:
    """A well-typed command, its arguments in canonical order."""

    action: Action
    arguments: tuple[Argument, ...] = ()
    span: Span | None = field(default=None, compare=False)

    def argument(self, name: str) -> Value | None:
        """The value of an argument, None where it was left out."""
        return next((argument.value for argument in self.arguments if argument.name == name), None)


@dataclass(frozen=True, slots=True)
class Program:
    """1 to 4 well-typed commands."""

    commands: tuple[Command, ...]
