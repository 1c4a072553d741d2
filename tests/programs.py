"""Writes programs for tests."""

from wayword.compiler.vocabulary import ACTIONS


def program(action: str, **parameters: str) -> str:
    """The canonical text of one command."""
    lines = [f"command_type: {ACTIONS[action].command_type}", f"action: {action}"]
    if parameters:
        lines.append("parameters:")
    for name, value in parameters.items():
        lines += [f"  - name: {name}", f"    value: {value}"]
    return "\n".join(lines) + "\n"


def join(*programs: str) -> str:
    """Several commands as one program."""
    return "---\n".join(programs)
