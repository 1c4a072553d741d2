"""What is wrong with a grammar, as values: where, which construct, why, and a way out."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Position:
    """A place in a source file.

    Attributes:
        file: Path or name of the file.
        line: Line number, from 1.
        column: Column number in characters, from 1.
    """

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One thing that is wrong with a grammar.

    Attributes:
        position: Where the construct stands; None where there is no source (a grammar built in memory).
        construct: The construct as a person would call it, for example ``lookahead``.
        message: Why it is refused.
        help: A way out.
    """

    position: Position | None
    construct: str
    message: str
    help: str

    def __str__(self) -> str:
        where = f"{self.position}: " if self.position else ""
        return f"{where}{self.construct}: {self.message} (help: {self.help})"


class GrammarError(ValueError):
    """A grammar that is wrong, or that holds what a target can't express.

    Attributes:
        diagnostics: All that was found, in source order; never empty.
    """

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(map(str, self.diagnostics)))
