"""Reads Lark files by Lark's own loader, which resolves imports and overrides, and keeps positions.

Lark's loader forgets where a name stood and which file a definition came from. `SourceBuilder` parses each
file once more with Lark's own parser of grammars and writes the position of every node into that node's
``meta``.
"""

import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeAlias

from lark import Token, Tree, load_grammar
from lark.exceptions import GrammarError as LarkGrammarError
from lark.exceptions import UnexpectedInput
from lark.lexer import Pattern
from lark.tree import Meta

from wayword.grammar.diagnostics import Diagnostic, GrammarError, Position

Node: TypeAlias = Any
"""A `lark.Tree` of Lark's grammar of grammars; what its children are depends on its ``data``."""
Mangle: TypeAlias = Callable[[str], str]

LARK_REFERENCE = "see https://lark-parser.readthedocs.io/en/stable/grammar.html"

# What Lark neither publishes nor types, all in one place.
parse_literal: Callable[[Token], Pattern] = load_grammar._literal_to_pattern
_parser_of_grammars: Callable[[], Any] = load_grammar._get_parser
_describe: Callable[[UnexpectedInput], str] = load_grammar._error_repr
_mangler: Callable[[str, dict[str, str], Mangle | None], Mangle] = load_grammar._get_mangle


class _Placed(Meta):
    """The metadata of a node whose position is known."""

    def __init__(self, position: Position) -> None:
        super().__init__()  # type: ignore[no-untyped-call]
        self.position = position


def position_of(node: Node) -> Position:
    """Return where a node of a definition's tree begins."""
    placed = node.meta
    assert isinstance(placed, _Placed), "every node of a definition gets a position when it is read"
    return placed.position


class SourceBuilder(load_grammar.GrammarBuilder):
    """Lark's builder of grammars, with positions.

    Attributes:
        positions: Where each definition's name stands, by the name under which Lark knows it.
        refused: Statements without which the text alone doesn't fix the language.
    """

    def __init__(self, used_files: dict[str, str] | None = None) -> None:
        super().__init__(used_files=used_files)
        self.positions: dict[str, Position] = {}
        self.refused: list[Diagnostic] = []
        self._file = ""
        self._unread: Iterator[Node] = iter(())

    @property
    def definitions(self) -> Mapping[str, Any]:
        """Definitions by name: ``is_term``, ``tree``, ``params``, ``options``."""
        return self._definitions

    def load_grammar(self, grammar_text: str, grammar_name: str = "<?>", mangle: Mangle | None = None) -> None:
        """Read one file and what it imports."""
        self._file = str(getattr(grammar_name, "path", grammar_name))  # Lark's own files are resources.
        raw = _parse(grammar_text, self._file)
        self._unread = (each for each in raw.children if each.data in _DEFINING)
        self.refused.extend(_refused_statements(raw, self._file, is_imported=mangle is not None))
        try:
            super().load_grammar(grammar_text, grammar_name, mangle)
            if mangle is None:
                self.validate()
        except LarkGrammarError as error:
            raise _located(error, raw, self._file) from error

    def _unpack_definition(self, tree: Node, mangle: Mangle | None) -> Any:
        statement = next(self._unread)
        raw = _unwrapped(statement)
        name = next(child for child in raw.children if isinstance(child, Token))
        position = _place(tree, raw, _position(name, self._file))
        definition = super()._unpack_definition(tree, mangle)  # type: ignore[no-untyped-call]
        if statement.data != "extend":
            self.positions[str(definition[0])] = position
        return definition

    def do_import(
        self,
        dotted_path: tuple[str, ...],
        base_path: Any,
        aliases: dict[str, str],
        base_mangle: Mangle | None = None,
    ) -> None:
        """Import from another file. Lark's own version makes plain builders, which lose the positions."""
        path, text = self._find(dotted_path, base_path)
        mangle = _mangler("__".join(dotted_path), aliases, base_mangle)
        imported = SourceBuilder(self.used_files)
        imported.load_grammar(text, path, mangle)
        imported._remove_unused(map(mangle, aliases))  # type: ignore[no-untyped-call]
        clash = next((name for name in imported.definitions if name in self._definitions), None)
        if clash is not None:
            raise LarkGrammarError(f"Cannot import '{clash}': it is already defined")
        self._definitions.update(imported.definitions)
        self.positions.update(imported.positions)
        self.refused.extend(imported.refused)

    def _find(self, dotted_path: tuple[str, ...], base_path: Any) -> tuple[Any, str]:
        relative = Path(*dotted_path).with_suffix(load_grammar.EXT)
        if isinstance(base_path, str) and (beside := Path(base_path) / relative).is_file():
            return str(beside), beside.read_text(encoding="utf-8")
        try:
            return load_grammar.stdlib_loader(base_path, relative.as_posix())
        except OSError as error:
            raise LarkGrammarError(f"There is no grammar file '{relative}' to import from") from error


_DEFINING = ("rule", "term", "override", "extend")


def _unwrapped(statement: Node) -> Node:
    """Return the rule or terminal inside ``%override`` and ``%extend``."""
    return statement.children[0] if statement.data in ("override", "extend") else statement


def _parse(text: str, file: str) -> Node:
    try:
        tree: Node = _parser_of_grammars().parse(text + "\n", "start")
    except UnexpectedInput as error:
        position = Position(file, max(error.line, 1), max(error.column, 1))
        message = _describe(error).splitlines()[0]
        diagnostic = Diagnostic(position, "syntax error", message, LARK_REFERENCE)
        raise GrammarError([diagnostic]) from error
    return tree


def _place(node: Node, raw: Node, default: Position) -> Position:
    """Write positions into a prepared tree from the raw tree of the same shape; return where it begins."""
    position: Position | None = None
    for child, raw_child in zip(node.children, raw.children, strict=True):
        if isinstance(raw_child, Token):
            begins = _position(raw_child, default.file)
        elif isinstance(child, Tree):
            begins = _place(child, raw_child, position or default)
        else:  # A name: Lark has made a symbol without a position of it.
            begins = _first_token(raw_child, default)
        position = position or begins
    node._meta = _Placed(position or default)
    return position or default


def _first_token(raw: Node, default: Position) -> Position:
    token = next(raw.scan_values(lambda value: isinstance(value, Token)), None)
    return _position(token, default.file) if token is not None else default


def _refused_statements(raw: Node, file: str, *, is_imported: bool) -> Iterator[Diagnostic]:
    for statement in raw.children:
        position = _first_token(statement, Position(file, 1, 1))
        if statement.data == "ignore" and not is_imported:  # Lark leaves an imported file's %ignore out.
            yield Diagnostic(
                position,
                "%ignore",
                "ignored text may stand between any two tokens, which no emitter can express",
                "write the text into the rules where it may stand",
            )
        if statement.data == "declare":
            yield Diagnostic(
                position,
                "%declare",
                "a declared terminal is made by a program, so that the grammar doesn't say which text it is",
                "define the terminal by a string or a regular expression",
            )


def _located(error: LarkGrammarError, raw: Node, file: str) -> GrammarError:
    """Find the name that Lark's message is about, since Lark gives no position."""
    message = str(error).splitlines()[0]
    tokens: dict[str, Token] = {}
    for token in raw.scan_values(lambda value: isinstance(value, Token)):
        tokens.setdefault(str(token), token)
    words = re.findall(r"'(\w+)'", message) + re.findall(r"\w+", message)
    named = next((tokens[word] for word in words if word in tokens), None)
    position = _position(named, file) if named is not None else Position(file, 1, 1)
    return GrammarError([Diagnostic(position, "definition", message, LARK_REFERENCE)])


def _position(token: Token, file: str) -> Position:
    return Position(file, token.line or 1, token.column or 1)
