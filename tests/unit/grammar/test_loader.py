"""Each construct of a Lark grammar has its translation, its positions, and nothing is dropped in silence."""

from collections.abc import Callable
from pathlib import Path

import pytest

from wayword.grammar import GrammarError, is_sentence, load_file, load_text
from wayword.grammar.ir import (
    CharSet,
    Choice,
    Expression,
    Literal,
    Reference,
    Repeat,
    Sequence,
    char_set,
)

A, B, C = Literal("a"), Literal("b"), Literal("c")


def chars(*spans: str) -> CharSet:
    return char_set((ord(span[0]), ord(span[-1])) for span in spans)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('"a"', A),
        ('"a" "b"', Sequence((A, B))),
        ('"a" | "b"', Choice((A, B))),
        ('"a" | "b" | "a"', Choice((A, B))),
        ('("a" | "b") "c"', Sequence((Choice((A, B)), C))),
        ('"a" ("b" "c")', Sequence((A, B, C))),
        ('"a"?', Repeat(A, 0, 1)),
        ('["a"]', Repeat(A, 0, 1)),
        ('["a" | "b"]', Repeat(Choice((A, B)), 0, 1)),
        ('"a"*', Repeat(A, 0, None)),
        ('"a"+', Repeat(A, 1, None)),
        ('"a"~3', Repeat(A, 3, 3)),
        ('"a"~0..3', Repeat(A, 0, 3)),
        ('("a" "b")~2..2', Repeat(Sequence((A, B)), 2, 2)),
        ('"a".."z"', chars("a-z")),
        ('"a" |', Choice((A, Sequence(())))),
        ('"a" -> name | "b" -> other', Choice((A, B))),
        ('"\\n\\t\\"\\\\"', Literal('\n\t"\\')),
        ('"\\u00e9"', Literal("é")),
        ('"a1"i', Sequence((chars("A", "a"), chars("1")))),
        ("/[a-c]x?/", Sequence((chars("a-c"), Repeat(Literal("x"), 0, 1)))),
        ("/a\\/b/", Literal("a/b")),
        ("/./s", CharSet(((0, 0x10FFFF),))),
    ],
)
def test_constructs(body: str, expected: Expression) -> None:
    assert load_text(f"start: {body}\n").rules["start"].body == expected


@pytest.mark.parametrize("prefix", ["", "?", "!", "?!"])
def test_prefixes_shape_only_the_tree(prefix: str) -> None:
    grammar = load_text(f'start: item\n{prefix}item: "a"\n')
    assert grammar.rules["item"].body == A


def test_terminals_keep_their_names() -> None:
    grammar = load_text('start: WORD\nWORD: LETTER+\nLETTER: "a" | "b"\n')
    assert list(grammar.rules) == ["start", "WORD", "LETTER"]
    assert grammar.rules["WORD"].body == Repeat(Reference("LETTER"), 1, None)
    assert [rule.is_terminal for rule in grammar.rules.values()] == [False, True, True]


def test_only_what_the_start_rule_reaches_is_loaded() -> None:
    grammar = load_text('start: "a"\nother: THING\nTHING: /(?=x)x/\n')
    assert list(grammar.rules) == ["start"]


def test_templates_are_instantiated() -> None:
    grammar = load_text('start: list{"a", DOT} | list{item, ","}\nlist{x, by}: x (by x)*\nitem: "i"\nDOT: "."\n')
    assert list(grammar.rules) == ["start", 'list{"a",DOT}', 'list{item,","}', "DOT", "item"]
    assert is_sentence(grammar, "a.a.a")
    assert is_sentence(grammar, "i,i")
    assert not is_sentence(grammar, "a,a")


def test_templates_nest_recur_and_take_templates() -> None:
    grammar = load_text(
        'start: twice{quoted{"a"}} | apply{quoted, "b"} | deep{"d"}\n'
        'twice{x}: x x\nquoted{x}: "\'" x "\'"\napply{t, x}: t{x}\n'
        'deep{x}: x | "(" deep{x} ")"\n'
    )
    for text in ("'a''a'", "'b'", "d", "((d))"):
        assert is_sentence(grammar, text), text
    assert not is_sentence(grammar, "'a'")


def test_arguments_of_templates_are_told_apart() -> None:
    grammar = load_text("""start: t{"a\\",\\"b", "c"} | t{"a", "b\\",\\"c"}\nt{x, y}: x "1" y\n""")
    assert len(grammar.rules) == 3
    assert is_sentence(grammar, 'a","b1c')
    assert is_sentence(grammar, 'a1b","c')


def test_imports_from_lark_and_from_a_file(lark_file: Callable[..., Path]) -> None:
    path = lark_file(
        "%import common.INT\n%import .words (pair, WORD)\n%import .words.NUMBER -> NUM\nstart: pair INT WORD NUM\n",
        words='pair: WORD "=" hidden\nhidden: WORD\nWORD: "w"\nNUMBER: "0".."9"\n',
    )
    grammar = load_file(path)
    assert is_sentence(grammar, "w=w42w7")
    assert not is_sentence(grammar, "w=w42w77")
    position = grammar.rules["words__hidden"].position
    assert str(position) == f"{path.with_name('words.lark')}:2:1"


def test_extend_and_override(lark_file: Callable[..., Path]) -> None:
    path = lark_file(
        '%import .base (word, OTHER)\n%extend word: "b"\n%override OTHER: "new"\nstart: word OTHER\n',
        base='word: "a"\nOTHER: "old"\n',
    )
    grammar = load_file(path)
    assert [text for text in ("anew", "bnew", "aold", "bold") if is_sentence(grammar, text)] == ["anew", "bnew"]
    assert str(grammar.rules["word"].position).endswith("base.lark:1:1")
    assert str(grammar.rules["OTHER"].position).endswith("main.lark:3:11")
    alternatives = grammar.rules["word"].body
    assert isinstance(alternatives, Choice)
    files = {str(each.position).split("/")[-1] for each in alternatives.alternatives}
    assert files == {"main.lark:2:15", "base.lark:1:7"}


def test_positions_are_kept_and_left_out_of_equality() -> None:
    first = load_text('start: "a"\n    | item\nitem: "b"~2\n', "one.lark")
    second = load_text('start: "a" | item\n\nitem: "b"~2\n', "two.lark")
    assert first == second
    choice = first.rules["start"].body
    assert isinstance(choice, Choice)
    assert [str(each.position) for each in choice.alternatives] == ["one.lark:1:8", "one.lark:2:7"]
    assert str(first.rules["item"].position) == "one.lark:3:1"
    assert str(first.rules["item"].body.position) == "one.lark:3:7"


REFUSED = [
    ('start: "a"\nWS: " "\n%ignore WS\n', "%ignore", 3, 9),
    ('start: "a"\n%ignore " "\n', "%ignore", 2, 9),
    ('start: "a" X\n%declare X\n', "%declare", 2, 10),
    ("start: A\nA: /a(?=b)/\n", "lookahead", 2, 4),
    ("start: A\nA: /a(?!b)/\n", "negative lookahead", 2, 4),
    ("start: A\nA: /(?<=b)a/\n", "lookbehind", 2, 4),
    ('start: A\nA: "x"\n | /(?<!b)a/\n', "negative lookbehind", 3, 4),
    ("start: /a\\b/\n", r"word boundary \b", 1, 8),
    ("start: /a\\B/\n", r"word boundary \B", 1, 8),
    ("start: /^a/\n", "anchor ^", 1, 8),
    ("start: /a$/\n", "anchor $", 1, 8),
    ("start: /\\Aa/\n", r"anchor \A", 1, 8),
    ("start: /a\\Z/\n", r"anchor \Z", 1, 8),
    ("start: /(a)\\1/\n", "backreference", 1, 8),
    ("start: /(a)?(?(1)b|c)/\n", "conditional group", 1, 8),
    ("start: /a++/\n", "possessive repetition", 1, 8),
    ("start: /(?>a)/\n", "atomic group", 1, 8),
    ("start: /\\d/\n", r"category \d", 1, 8),
    ('start: "x" /[\\w.]/\n', r"category \w", 1, 12),
    ("start: /\\S/\n", r"category \S", 1, 8),
    ("start: /a/l\n", "regular expression", 1, 8),
    ("start: /(a/\n", "regular expression", 1, 8),
    ('start: A\nA.2: "a"\n', "priority of A", 2, 1),
    ('start: b\nb.2: "a"\n', "priority of b", 2, 1),
    ("start: A\nA: /a*/\n", "terminal A", 2, 1),
    ('start: ""\n', 'literal ""', 1, 8),
    ('start: "a"~3..1\n', "repetition ~3..1", 1, 8),
    ('start: t\nt{x}: x "a"\n', "template t", 2, 1),
    ('start: t{"a"}\nt{x}: x t{u{x}}\nu{x}: x\n', "template t", 2, 9),
    ("start: missing\n", "definition", 1, 8),
    ("start: A\nA: B\n", "definition", 2, 4),
    ('start: t{"a"}\nt{x, y}: x y\n', "definition", 1, 8),
    ('start: "a"\nstart: "b"\n', "definition", 1, 1),
    ('start: "a"\n%import .nowhere.X\n', "definition", 2, 10),
    ('start: ("a"\n', "syntax error", 1, 12),
    ('start: A\nA: "a" & \n', "syntax error", 2, 8),
]


@pytest.mark.parametrize(("text", "construct", "line", "column"), REFUSED)
def test_refused_constructs(text: str, construct: str, line: int, column: int) -> None:
    with pytest.raises(GrammarError) as caught:
        load_text(text, "bad.lark")
    diagnostic = caught.value.diagnostics[0]
    assert (diagnostic.construct, str(diagnostic.position)) == (construct, f"bad.lark:{line}:{column}")
    assert diagnostic.message
    assert diagnostic.help
    assert str(caught.value).startswith(f"bad.lark:{line}:{column}: {construct}: ")


def test_all_problems_are_reported_at_once_in_source_order() -> None:
    with pytest.raises(GrammarError) as caught:
        load_text("start: A | B\nA: /\\d/\nB: /x$/\n%declare Z\n")
    assert [each.construct for each in caught.value.diagnostics] == [r"category \d", "anchor $", "%declare"]


def test_a_refused_construct_in_an_imported_file_is_found_there(lark_file: Callable[..., Path]) -> None:
    path = lark_file("%import .words.W\nstart: W\n", words="// words\nW: /w(?=x)/\n")
    with pytest.raises(GrammarError, match=r"words\.lark:2:4: lookahead"):
        load_file(path)


def test_a_refused_construct_in_lark_s_library_is_found_there() -> None:
    with pytest.raises(GrammarError, match=r"grammars/common\.lark:\d+:\d+: negative lookbehind"):
        load_text("%import common.ESCAPED_STRING\nstart: ESCAPED_STRING\n")


def test_unknown_start_rule() -> None:
    with pytest.raises(GrammarError, match="start rule program: the grammar doesn't define it"):
        load_text('start: "a"\n', start="program")
