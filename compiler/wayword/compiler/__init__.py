"""The Wayword compiler: parse, check, lower. Pure: no input or output, no clock, no randomness.

Typical use::

    from wayword.compiler import compile_program

    result = compile_program("command_type: MISSION\\naction: START\\n")
    for command in result.commands:
        print(*command.instructions, sep="\\n")
"""

from collections.abc import Sequence
from dataclasses import dataclass

from wayword.compiler.checker import check
from wayword.compiler.diagnostics import CODES, Code, Diagnostic, Severity
from wayword.compiler.formatter import equivalent, format_command, format_program
from wayword.compiler.instructions import Await, Do, Instruction, Require, Scalar, Symbol
from wayword.compiler.lowering import LoweredCommand, lower
from wayword.compiler.parser import parse
from wayword.compiler.render import render, render_all
from wayword.compiler.status import VehicleStatus
from wayword.compiler.syntax import Command, Program

__all__ = [
    "CODES",
    "Await",
    "Code",
    "Command",
    "Compilation",
    "Diagnostic",
    "Do",
    "Instruction",
    "LoweredCommand",
    "Program",
    "Require",
    "Scalar",
    "Severity",
    "Symbol",
    "VehicleStatus",
    "compile_program",
    "equivalent",
    "format_command",
    "format_program",
    "lower",
    "render",
    "render_all",
]


@dataclass(frozen=True, slots=True)
class Compilation:
    """What became of a source text.

    Attributes:
        source: The text.
        program: The well-typed program, None where there is an error.
        commands: Its commands with their instructions, in order.
        diagnostics: All that there is to say about the text.
    """

    source: str
    program: Program | None
    commands: tuple[LoweredCommand, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def ok(self) -> bool:
        """Whether there is something to execute."""
        return self.program is not None

    @property
    def canonical(self) -> str:
        """The program in canonical form.

        Raises:
            ValueError: There is none, because of an error.
        """
        if self.program is None:
            raise ValueError("a text with errors has no canonical form")
        return format_program(self.program)


def compile_program(source: str, places: Sequence[str] | None = None) -> Compilation:
    """Compiles a program from text to executor instructions.

    Args:
        source: The program.
        places: Names on the loaded map. None accepts any well-formed name.

    Returns:
        The instructions, or the diagnostics that say why there are none. Never raises for bad source text.
    """
    written, problems = parse(source)
    if problems:
        return Compilation(source, None, (), problems)
    program, problems = check(written, places)
    return Compilation(source, program, lower(program) if program else (), problems)
