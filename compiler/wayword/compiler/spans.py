"""Places in a source text."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of one source line.

    Attributes:
        line: Line number from 1.
        column: Column of the first character, from 1.
        end_column: Column after the last character.
    """

    line: int
    column: int
    end_column: int
