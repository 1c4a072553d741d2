"""Loads a Lark grammar into the intermediate form.

The result describes the grammar without its lexer: the strings that its rules derive, terminals expanded.
Prefixes ``?``, ``_``, ``!`` and aliases shape only Lark's tree and leave no trace. What would change the
language and has no counterpart in the intermediate form is reported, all at once.
"""

import re
from pathlib import Path

from lark import Token
from lark.exceptions import GrammarError as LarkGrammarError
from lark.grammar import Symbol
from lark.lexer import PatternRE

from wayword.grammar import regex
from wayword.grammar.analysis import nullable_rules
from wayword.grammar.diagnostics import Diagnostic, GrammarError, Position
from wayword.grammar.ir import (
    CharSet,
    Expression,
    Grammar,
    Literal,
    Reference,
    Repeat,
    Rule,
    choice,
    references,
    sequence,
)
from wayword.grammar.sources import LARK_REFERENCE, Node, SourceBuilder, parse_literal, position_of

MAX_NAME_LENGTH = 1_000
"""A template's instance with a longer name means that the template instantiates itself without end."""

_OPERATORS: dict[str, tuple[int, int | None]] = {"?": (0, 1), "*": (0, None), "+": (1, None)}
_Bindings = dict[str, Expression]


def load_file(path: str | Path, start: str = "start") -> Grammar:
    """Load a grammar from a file.

    Args:
        path: A Lark file; imports are looked for beside it and in Lark's own library.
        start: The start rule. What it doesn't reach is left out.

    Raises:
        GrammarError: The grammar is wrong or holds what can't be expressed.
    """
    return load_text(Path(path).read_text(encoding="utf-8"), str(path), start)


def load_text(text: str, file: str = "<string>", start: str = "start") -> Grammar:
    """Load a grammar from its text; ``file`` is what positions name, and where relative imports begin."""
    builder = SourceBuilder()
    builder.load_grammar(text, file)
    loader = _Loader(builder)
    if start not in builder.definitions:
        loader.refuse(Position(file, 1, 1), f"start rule {start}", "the grammar doesn't define it", "name another one")
    else:
        loader.load(start)
    if loader.diagnostics:
        raise GrammarError(sorted(loader.diagnostics, key=_source_order))
    return Grammar(start, loader.rules, (f"{Path(file).name}, start rule {start}",))


def _source_order(diagnostic: Diagnostic) -> tuple[str, int, int]:
    position = diagnostic.position
    return (position.file, position.line, position.column) if position else ("", 0, 0)


class _Loader:
    """Converts definitions on demand, beginning at the start rule."""

    def __init__(self, builder: SourceBuilder) -> None:
        self.diagnostics = list(builder.refused)
        self.rules: dict[str, Rule] = {}
        self._builder = builder
        self._terminals = {id(each.tree): name for name, each in builder.definitions.items() if each.is_term}
        self._instances: dict[str, tuple[str, _Bindings]] = {}

    def load(self, start: str) -> None:
        """Load a rule and all that it reaches."""
        pending = [start]
        while pending:
            name = pending.pop(0)
            if name in self.rules:
                continue
            self.rules[name] = rule = self._rule(name)
            pending.extend(reference.name for reference in references(rule.body))
        if not self.diagnostics:  # What was refused has left a gap, which is empty.
            self._refuse_empty_terminals()

    def refuse(self, position: Position | None, construct: str, message: str, way_out: str) -> None:
        """Note a construct that can't be expressed."""
        diagnostic = Diagnostic(position, construct, message, way_out)
        if diagnostic not in self.diagnostics:
            self.diagnostics.append(diagnostic)

    def _position(self, name: str) -> Position | None:
        return self._builder.positions.get(self._instances.get(name, (name, {}))[0])

    def _rule(self, name: str) -> Rule:
        template, bindings = self._instances.get(name, (name, {}))
        definition = self._builder.definitions[template]
        position = self._position(name)
        if definition.params and name == template:
            self.refuse(position, f"template {name}", "it is used without arguments", f"write {name}{{...}}")
            return Rule(name, Literal(""), position=position)
        if definition.tree is None:  # Declared; the statement was reported.
            return Rule(name, Literal(""), definition.is_term, position=position)
        priority = definition.options if definition.is_term else definition.options.priority
        if priority:
            self.refuse(
                position,
                f"priority of {name}",
                "which of two readings wins can't be said in a context-free grammar",
                "make the alternatives exclude each other and drop the priority",
            )
        return Rule(name, self._convert(definition.tree, bindings), definition.is_term, position=position)

    def _refuse_empty_terminals(self) -> None:
        nullable = nullable_rules(self.rules)
        used = {each.name for rule in self.rules.values() if not rule.is_terminal for each in references(rule.body)}
        for name in used & nullable:
            if self.rules[name].is_terminal:
                self.refuse(
                    self._position(name),
                    f"terminal {name}",
                    "it matches the empty string, which Lark's lexer refuses",
                    "let it match at least one character and make its use optional",
                )

    def _convert(self, node: Node, bindings: _Bindings) -> Expression:
        position = position_of(node)
        match node.data:
            case "expansions":
                return choice((self._convert(child, bindings) for child in node.children), position)
            case "expansion":
                return sequence((self._convert(child, bindings) for child in node.children), position)
            case "alias":
                return self._convert(node.children[0], bindings)
            case "maybe":
                return Repeat(self._convert(node.children[0], bindings), 0, 1, position=position)
            case "expr":
                return self._repeat(node, bindings)
            case "range":
                low, high = (token.value[1:-1] for token in node.children)
                return self._pattern(PatternRE(f"[{low}-{high}]"), position)  # As Lark reads it.
            case "literal":
                return self._literal(node.children[0], position)
            case "template_usage":
                return self._instance(node, bindings)
            case "value":
                return self._value(node, bindings)
        raise AssertionError(f"Lark's loader makes no such node: {node.data}")

    def _repeat(self, node: Node, bindings: _Bindings) -> Expression:
        body = self._convert(node.children[0], bindings)
        operator, *bounds = node.children[1:]
        low, high = _OPERATORS[operator] if not bounds else (int(bounds[0]), int(bounds[-1]))
        position = position_of(node)
        if high is not None and not 0 <= low <= high:
            self.refuse(position, f"repetition ~{low}..{high}", "no number lies in it", "write the lower bound first")
        return Repeat(body, low, high, position=position)

    def _value(self, node: Node, bindings: _Bindings) -> Expression:
        child = node.children[0]
        if isinstance(child, Symbol):
            return bindings.get(child.name) or Reference(str(child.name), position=position_of(node))
        terminal = self._terminals.get(id(child))
        if terminal is not None:  # Lark has put the terminal's own tree in place of its name.
            return Reference(terminal, position=position_of(node))
        return self._convert(child, bindings)

    def _literal(self, token: Token, position: Position) -> Expression:
        try:
            pattern = parse_literal(token)
        except LarkGrammarError as error:
            self.refuse(position, f"literal {token}", str(error).splitlines()[0], LARK_REFERENCE)
            return Literal("")
        if isinstance(pattern, PatternRE):
            return self._pattern(pattern, position)
        if "i" not in pattern.flags:
            return Literal(pattern.value, position=position)
        return self._pattern(PatternRE(re.escape(pattern.value), ("i",)), position)

    def _pattern(self, pattern: PatternRE, position: Position) -> Expression:
        try:
            return regex.translate(pattern.value, pattern.flags, position)
        except regex.RegexError as error:
            self.refuse(position, error.construct, f"{error.message}, in /{pattern.value}/", error.help)
            return Literal("")

    def _instance(self, node: Node, bindings: _Bindings) -> Expression:
        """Note an instance of a template under a name that tells its arguments, and refer to it."""
        symbol, *arguments = node.children
        bound = bindings.get(symbol.name)
        template = bound.name if isinstance(bound, Reference) else str(symbol.name)
        values = [self._convert(argument, bindings) for argument in arguments]
        name = f"{template}{{{','.join(map(_label, values))}}}"
        parameters = self._builder.definitions[template].params
        if len(parameters) != len(values):
            message = f"it takes {len(parameters)} arguments and is given {len(values)}"
            self.refuse(position_of(node), f"template {template}", message, "give it as many as it takes")
        if len(name) > MAX_NAME_LENGTH:
            message = "it instantiates itself without end"
            self.refuse(position_of(node), f"template {template}", message, "use it with the same arguments in itself")
            return Literal("")
        self._instances[name] = (template, dict(zip(parameters, values, strict=False)))
        return Reference(name, position=position_of(node))


def _label(argument: Expression) -> str:
    """Write an argument of a template so that different arguments never look the same."""
    match argument:
        case Reference(name):
            return name
        case Literal(text):
            escaped = text.replace("\\", r"\\").replace('"', r"\"")
            return f'"{escaped}"'
        case CharSet(ranges):
            return "-".join(f"{low:x}..{high:x}" for low, high in ranges)
        case _:
            return repr(argument)
