"""The emitter writes what llama.cpp reads; the linter refuses, with a position, what would crash or hang it."""

from random import Random
from typing import Protocol

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from wayword.grammar import GrammarError, check_gbnf, generate, is_sentence, lint_gbnf, load_text, to_gbnf
from wayword.grammar.gbnf_parser import GbnfParser
from wayword.grammar.ir import (
    CharSet,
    Expression,
    Grammar,
    Literal,
    Reference,
    Repeat,
    Rule,
    char_set,
    choice,
    complement,
    sequence,
)


class Engine(Protocol):
    def compiles(self, gbnf: str) -> bool: ...

    def spells(self, text: str) -> bool: ...

    def accepts(self, gbnf: str, text: str, *, by_character: bool = False) -> bool: ...


def grammar_of(*rules: tuple[str, Expression]) -> Grammar:
    return Grammar(rules[0][0], {name: Rule(name, body) for name, body in rules})


def printed(body: Expression) -> str:
    return to_gbnf(grammar_of(("start", body))).splitlines()[-1].removeprefix("root ::= ")


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('"a\\n\\"\\\\\\t\\r"', r'"a\n\"\\\t\r"'),
        ('"é\\u0007\\u00a0\\u2028\\U0001f600"', '"é\\x07\\xA0\\u2028😀"'),
        ("/[\\]\\[a-]/", r"[\[\]a-]"),
        ("/[\\\\^]/", r"[\\\x5E]"),
        ("/[+--]/", r"[+-\x2D]"),
        ("/[^\\n]/", r"[^\n]"),
        ("/[^\\-^]/", r"[^\x5E-]"),
        ("/[^é]/", "[\\x00-èê-\\U0010FFFF]"),
        ("/./s", "."),
        ('"a" | "b"', "[ab]"),
        ('"aa" | "bb"', '"aa" | "bb"'),
        ('("aa" | "bb") "c"', '("aa" | "bb") "c"'),
        ('("a" "b")+', '"ab"+'),
        ('("a" x)* x\nx: "x" x?', '("a" x)* x'),
        ('("a"~2)~3', '("a"{2}){3}'),
        ('"a"~2..4 "b"~0..1 /c{2,}/', '"a"{2,4} "b"? "c"{2,}'),
        ('x |\nx: "x" x?', 'x | ""'),
    ],
)
def test_printing(body: str, expected: str) -> None:
    lines = to_gbnf(load_text(f"start: {body}\n")).splitlines()
    assert lines[2] == f"root ::= {expected}"


characters = st.characters(exclude_characters="\0", exclude_categories=["Cs"])


@given(st.text(characters, min_size=1))
def test_string_escapes_round_trip(text: str) -> None:
    assert GbnfParser(f"root ::= {printed(Literal(text))}\n").rules["root"].body == Literal(text)


@given(st.lists(st.tuples(characters, characters), min_size=1), st.booleans())
def test_class_escapes_round_trip(pairs: list[tuple[str, str]], negated: bool) -> None:
    ranges = char_set((min(ord(a), ord(b)), max(ord(a), ord(b))) for a, b in pairs).ranges
    expected = CharSet(complement(ranges) if negated else ranges)
    if expected.ranges:
        assert GbnfParser(f"root ::= {printed(expected)}\n").rules["root"].body == expected


@pytest.mark.parametrize("text", ['"quoted" \\ back', "[a-z]^-]", "tab\tnl\ncr\rbell\x07", "é ü 漢字 😀 \u2028", "#no"])
def test_escapes_mean_the_same_to_llama(text: str, llama: Engine) -> None:
    literal = to_gbnf(grammar_of(("start", Literal(text))))
    each = to_gbnf(grammar_of(("start", Repeat(char_set((ord(char),) * 2 for char in text), 1, None))))
    for gbnf in (literal, each):
        assert llama.accepts(gbnf, text)
        assert llama.accepts(gbnf, text, by_character=True)
        assert not llama.accepts(gbnf, text + "~")


def test_names() -> None:
    gbnf = to_gbnf(
        load_text(
            'start: my_rule list{"+", my_rule} list{",", my_rule} list{"a b", my_rule} NAME_2\n'
            'my_rule: "a" my_rule?\nlist{s, x}: x s x\nNAME_2: /[a-z]+/\n'
        )
    )
    names = [line.split(" ::= ")[0] for line in gbnf.splitlines()[2:]]
    assert names == ["root", "my-rule", "list-PLUS-my-rule", "list-COMMA-my-rule", "list-a-b-my-rule", "NAME-2"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            'start: a_b a__b\na_b: "x" a_b?\na__b: "y" a_b\n',
            "bad.lark:3:1: name a__b: in GBNF both it and a_b would be",
        ),
        ('start: root\nroot: "x" root?\n', "bad.lark:2:1: name root: in GBNF both it and start would be called root"),
        ('start: start "x" | "y"\n', "bad.lark:1:1: left recursion in start: it can begin with itself"),
        ('start: ("x"? "y"?)*\n', "bad.lark:1:9: repetition in start: what it repeats without a bound may be empty"),
        ('start: "x" start\n', "bad.lark:1:1: rule start: it derives no finite text"),
        ('start: "x"~0..2001\n', r"bad.lark:1:8: repetition \{0,2001\}: llama.cpp allows bounds up to 2000"),
        ('start: "x\\u0000"\n', "bad.lark:1:8: literal 'x.x00': it holds NUL"),
        ("start: /[^\\s\\S]/\n", "bad.lark:1:8: category"),
        ("start: /(?a:[^\\s\\S])/\n", "bad.lark:1:8: empty character class"),
        ("start: /[\\x00\\ud800-\\udfff]/\n", "bad.lark:1:8: empty character class"),
    ],
)
def test_what_llama_cannot_run_is_refused_where_it_stands(text: str, message: str) -> None:
    with pytest.raises(GrammarError, match=message):
        to_gbnf(load_text(text, "bad.lark"))


def test_a_file_name_cannot_end_the_header() -> None:
    gbnf = to_gbnf(load_text('start: "a"\n', 'x\nroot ::= "evil"'))
    assert [line for line in gbnf.splitlines() if not line.startswith("#")] == ['root ::= "a"']


DEEP = "(" * 110 + '"x"' + ")" * 110
MANY_PATHS = "root ::= r0\n" + "".join(f'r{i} ::= r{i + 1} "a" | r{i + 1} "b"\n' for i in range(30)) + 'r30 ::= "x"\n'
BAD = [
    ('start ::= "x"\n', "1:1", "rule root: there is none to start from"),
    ("", "1:1", "rule root: there is none"),
    ('root ::= "x" missing\n', "1:14", "rule missing: root refers to it, but it isn't defined"),
    ('root ::= root "x" | "y"\n', "1:1", "left recursion in root: it can begin with itself: root -> root"),
    ('root ::= a root "x" | "y"\na ::= b\nb ::= ""\n', "1:1", "left recursion in root"),
    ('root ::= ("a"? root)? "x"\n', "1:1", "left recursion in root"),
    (
        'root ::= "x"\na ::= b "x"\nb ::= a "y" | "z"\n',
        "2:1",
        "left recursion in a: it can begin with itself: a -> b -> a",
    ),
    ('root ::= "x" |\n', "1:14", "trailing |: no alternative follows it"),
    ('root ::= "x" |\na ::= "y"\n', "1:14", "trailing |"),
    ('root ::= ("x" | ) "y"\n', "1:15", "trailing |"),
    ('root ::= | "x"\n', "1:10", "empty alternative: no element stands here"),
    ('root ::= "x" | | "y"\n', "1:16", "empty alternative"),
    ("root ::= ()\n", "1:11", "empty alternative"),
    ('root ::=\na ::= "x"\n', "1:1", "rule root: it is empty"),
    ("root ::= ", "1:1", "rule root: it is empty"),
    ('root ::= ("x"?)*\n', "1:16", "repetition in root: what it repeats without a bound may be empty"),
    ('root ::= a+\na ::= b\nb ::= "x"?\n', "1:11", "repetition in root"),
    ('root ::= "x"{0,2001}\n', "1:13", "repetition: it makes 2001 rules; llama.cpp allows 2000"),
    ('root ::= "x"{2001}\n', "1:13", "repetition: it makes 2001 rules"),
    ('root ::= (("x"{0,50}){0,50})\n', "1:22", "repetition: it makes 2550 rules"),
    ('root ::= "x"{50}{50}\n', "1:17", "repetition: it makes 2500 rules"),
    ('root ::= "x"{3,1}\n', "1:13", "repetition: no number lies from 3 to 1"),
    ('root ::= "x"{,3}\n', "1:13", "repetition: its bounds can't be read"),
    ("root ::= *\n", "1:10", "repetition: nothing stands before it"),
    ('root ::= ""?\n', "1:12", "repetition: nothing stands before it"),
    ('root ::= a_b\na_b ::= "x"\n', "1:10", "name a_b: a name has only letters, digits and hyphens"),
    ('root ::= "x"\nbig_rule ::= "y"\n', "2:1", "name big_rule"),
    ('root ::= "x"\nroot ::= "y"\n', "2:1", "rule root: it is defined twice"),
    ('root ::= "x" | a\na ::= "y" a\n', "2:1", "rule a: it derives no finite text"),
    ("root ::= []\n", "1:10", "character class: it is empty"),
    ("root ::= [z-a]\n", "1:10", "character class: its range z-a ends before it begins"),
    ("root ::= [a\n", "1:10", "character class: it isn't closed"),
    ('root ::= "x\n', "1:10", "string: it isn't closed"),
    ('root ::= "\\x00"\n', "1:10", "string: it holds NUL"),
    ('root ::= "\\q"\n', "1:11", r"escape \q: llama.cpp doesn't know it"),
    ('root ::= "\\u12"\n', "1:11", r"escape \u12"),
    ("root ::= [a\\^]\n", "1:12", r"escape \^"),
    ('root ::= "\\U00110000"\n', "1:11", r"escape \U00110000: no character has that code"),
    ('root ::= ("x"\n', "1:10", "group: its parenthesis isn't closed"),
    ('root ::= "x")\n', "1:13", "character ')': it can't stand here"),
    ("root ::= <think>\n", "1:10", "character '<': nothing begins with it here"),
    ('root = "x"\n', "1:1", "rule root: it has no ::="),
    (f"root ::= {DEEP}\n", "1:110", "group: it is nested more than 100 deep"),
    (MANY_PATHS, "13:1", "rule r11: it begins along more than 1000000 paths"),
]


@pytest.mark.parametrize(("gbnf", "place", "message"), BAD)
def test_bad_gbnf_is_refused(gbnf: str, place: str, message: str) -> None:
    with pytest.raises(GrammarError) as caught:
        check_gbnf(gbnf, "bad.gbnf")
    assert str(caught.value).startswith(f"bad.gbnf:{place}: {message}")


def test_every_bad_rule_is_reported() -> None:
    found = lint_gbnf('root ::= "x" |\nnext ::= [z-a]\nlast ::= "\\q"\n')
    assert [str(each.position) for each in found] == ["<gbnf>:1:14", "<gbnf>:2:10", "<gbnf>:3:11"]


@pytest.mark.parametrize(
    "gbnf",
    [
        '# a comment\n\nroot ::= (a\n  | "b" # another\n) c* # end\r\na ::= "a"{2,}\nc ::=\n  [^\\x41-\\u005A\\]]',
        'root ::= "x"{1000} ("y" "z"){0,100} .',
        'root ::= "" | root2\nroot2 ::= "r" root2?',
    ],
)
def test_good_gbnf_passes_and_compiles(gbnf: str, llama: Engine) -> None:
    check_gbnf(gbnf)
    assert llama.compiles(gbnf)


names = st.sampled_from(["start", "one", "two"])
leaves = st.one_of(
    st.text("ab-]^é\n", min_size=1, max_size=3).map(Literal),
    st.lists(st.sampled_from("ab-]^é\n"), min_size=1).map(lambda found: char_set((ord(c), ord(c)) for c in found)),
    st.sampled_from("ab-]^é\n").map(lambda char: CharSet(complement([(ord(char), ord(char))]))),
    names.map(Reference),
)


def combined(inner: st.SearchStrategy[Expression]) -> st.SearchStrategy[Expression]:
    bounds = st.sampled_from([(0, 1), (0, None), (1, None), (2, 2), (1, 3), (2, None)])
    return st.one_of(
        st.lists(inner, min_size=2, max_size=3).map(sequence),
        st.lists(inner, min_size=2, max_size=5).map(choice),
        st.builds(lambda body, span: Repeat(body, *span), inner, bounds),
    )


expressions: st.SearchStrategy[Expression] = st.recursive(leaves, combined, max_leaves=6)


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(start=expressions, one=expressions, two=expressions, seed=st.integers(0, 999))
def test_any_grammar_means_the_same_to_llama(
    start: Expression, one: Expression, two: Expression, seed: int, llama: Engine
) -> None:
    grammar = grammar_of(("start", start), ("one", one), ("two", two))
    try:
        gbnf = to_gbnf(grammar)
    except GrammarError:
        return
    assert llama.compiles(gbnf)
    random = Random(seed)
    text = generate(grammar, random, budget=30)[:60]
    at = random.randrange(len(text) + 1)
    for candidate in ("", text, text[:at], text[:at] + "b" + text[at:], text[:at] + "é" + text[at + 1 :]):
        if "\0" not in candidate and llama.spells(candidate):
            assert llama.accepts(gbnf, candidate) == is_sentence(grammar, candidate), (gbnf, candidate)
