"""Text to written commands: the shape of a program, before any word in it is understood."""

from lark import Token, Tree, UnexpectedCharacters, UnexpectedEOF, UnexpectedInput, UnexpectedToken

from wayword import grammar
from wayword.compiler.diagnostics import UNEXPECTED_END, UNEXPECTED_TEXT, Diagnostic
from wayword.compiler.spans import Span
from wayword.compiler.syntax import Written, WrittenCommand, WrittenParameter


def parse(text: str) -> tuple[tuple[WrittenCommand, ...], tuple[Diagnostic, ...]]:
    """Parses a program's shape.

    Args:
        text: The program. A missing newline at the end is forgiven.

    Returns:
        The commands as written, and what is wrong with their shape; one of the two is empty.
    """
    if not text.strip():
        return (), (Diagnostic(UNEXPECTED_END, Span(1, 1, 2), "there is no command: expected `command_type: `"),)
    if not text.endswith("\n"):
        text += "\n"
    try:
        tree = grammar.parser("source").parse(text)
    except UnexpectedInput as error:
        return (), (_explain(error, text),)
    return tuple(_command(document) for document in tree.children if isinstance(document, Tree)), ()


def _command(document: Tree[Token]) -> WrittenCommand:
    command_type, action, *parameters = document.children
    assert isinstance(command_type, Token)
    assert isinstance(action, Token)
    return WrittenCommand(
        _written(command_type),
        _written(action),
        tuple(_parameter(parameter) for parameter in parameters if isinstance(parameter, Tree)),
    )


def _parameter(tree: Tree[Token]) -> WrittenParameter:
    name, value = (child for child in tree.children if isinstance(child, Token))
    return WrittenParameter(_written(name), _written(value))


def _written(token: Token) -> Written:
    line, column = token.line or 1, token.column or 1
    return Written(str(token), Span(line, column, column + len(token)))


def _explain(error: UnexpectedInput, text: str) -> Diagnostic:
    expected = f"expected {_spell(_expected_terminals(error))}"
    line = error.line if isinstance(error.line, int) else -1
    last_line = text.count("\n")
    if isinstance(error, UnexpectedEOF) or line > last_line or line < 1 or _at_end(error):
        end = len(text.split("\n")[last_line - 1]) + 1
        return Diagnostic(
            UNEXPECTED_END,
            Span(last_line, end, end),
            f"the program ends in the middle of a command: {expected}",
        )
    column = error.column if isinstance(error.column, int) and error.column > 0 else 1
    rest = text.split("\n")[line - 1][column - 1 :]
    found = f"found `{rest[:40]}`" if rest else "found the end of the line"
    return Diagnostic(
        UNEXPECTED_TEXT, Span(line, column, column + max(1, len(rest))), f"{expected}, {found}", _hint(rest)
    )


def _at_end(error: UnexpectedInput) -> bool:
    return isinstance(error, UnexpectedToken) and error.token.type == "$END"


def _expected_terminals(error: UnexpectedInput) -> set[str]:
    if isinstance(error, UnexpectedCharacters):
        return set(error.allowed or ())
    if isinstance(error, UnexpectedToken):
        return set(error.expected)
    return set(getattr(error, "expected", ()))


def _spell(terminals: set[str]) -> str:
    patterns = {terminal.name: terminal.pattern.value for terminal in grammar.parser("source").terminals}
    words = {"TEXT": "a word", "$END": "the end of the program"}
    spelt = []
    for name in sorted(terminals):
        literal = patterns.get(name, name).strip("\n")
        spelt.append(words.get(name) or (f"`{literal}`" if literal else "the end of the line"))
    return " or ".join(dict.fromkeys(spelt))


def _hint(rest: str) -> str | None:
    if "\t" in rest:
        return "indent with two spaces, not with tabs"
    if rest.startswith("#"):
        return "comments are not part of the language"
    if not rest.strip():
        return "remove the empty line"
    if rest.startswith(" "):
        return "two spaces before `- name:`, four before `value:`, none elsewhere"
    if rest.startswith("action:"):
        return "`command_type:` comes before `action:`"
    return None
