"""Shows diagnostics to people: the message, the source line, a caret below the place, and help."""

from collections.abc import Iterable, Sequence

from wayword.compiler.diagnostics import Diagnostic


def render(diagnostic: Diagnostic, source: str, name: str = "<program>") -> str:
    """Renders one diagnostic.

    Args:
        diagnostic: What to show.
        source: The text that it is about.
        name: The source's name, for the location line.

    Returns:
        Several lines without a trailing newline, for example::

            error[WW0303]: max_vel is out of bounds: 250 km/h
             --> trip.ww:5:12
              |
            5 |     value: 250 km/h
              |            ^^^^^^^^
              = help: 5 to 130 km/h are allowed
    """
    return _render(diagnostic, source.split("\n"), name)


def render_all(diagnostics: Iterable[Diagnostic], source: str, name: str = "<program>") -> str:
    """Renders several diagnostics with an empty line between them."""
    lines = source.split("\n")
    return "\n\n".join(_render(diagnostic, lines, name) for diagnostic in diagnostics)


def _render(diagnostic: Diagnostic, lines: Sequence[str], name: str) -> str:
    span = diagnostic.span
    text = _printable(lines[span.line - 1] if span.line <= len(lines) else "")
    margin = " " * len(str(span.line))
    carets = "^" * max(1, span.end_column - span.column)
    rendered = [
        f"{diagnostic.severity}[{diagnostic.code.name}]: {_printable(diagnostic.message)}",
        f"{margin}--> {name}:{span.line}:{span.column}",
        f"{margin} |",
        f"{span.line} | {text}",
        f"{margin} | {' ' * (span.column - 1)}{carets}",
    ]
    if diagnostic.help:
        rendered.append(f"{margin} = help: {diagnostic.help}")
    return "\n".join(rendered)


def _printable(text: str) -> str:
    """The text with a blot for every control character, so that the terminal stays whole and the carets fit."""
    return "".join(character if character.isprintable() else "\N{REPLACEMENT CHARACTER}" for character in text)
