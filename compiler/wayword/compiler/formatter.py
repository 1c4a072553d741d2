"""The canonical form of programs, and when two programs are the same."""

from math import isclose

from wayword.compiler.syntax import Command, Measurement, Program, Value


def format_program(program: Program) -> str:
    """Prints a program in canonical form."""
    return "---\n".join(format_command(command) for command in program.commands)


def format_command(command: Command) -> str:
    """Prints one command in canonical form, with a newline after each line."""
    lines = [f"command_type: {command.action.command_type}", f"action: {command.action.name}"]
    if command.arguments:
        lines.append("parameters:")
    for argument in command.arguments:
        lines += [f"  - name: {argument.name}", f"    value: {argument.value}"]
    return "\n".join(lines) + "\n"


def equivalent(one: Program, other: Program) -> bool:
    """Whether two programs are equal: their canonical forms in SI are, with a relative tolerance of 1e-9."""
    return len(one.commands) == len(other.commands) and all(
        a.action == b.action
        and len(a.arguments) == len(b.arguments)
        and all(x.name == y.name and _same(x.value, y.value) for x, y in zip(a.arguments, b.arguments, strict=True))
        for a, b in zip(one.commands, other.commands, strict=True)
    )


def _same(one: Value, other: Value) -> bool:
    if isinstance(one, Measurement) and isinstance(other, Measurement):
        return (
            one.unit.dimension is other.unit.dimension
            and one.signed == other.signed
            and isclose(one.si, other.si, rel_tol=1e-9)
        )
    return one == other
