"""Passes keep the language; analyses find what an engine can't run; specialisation and generation do as they say."""

from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wayword.grammar import GrammarError, generate, is_sentence, load, load_text, specialise
from wayword.grammar.analysis import (
    left_recursions,
    nullable_repetitions,
    nullable_rules,
    unproductive_rules,
)
from wayword.grammar.ir import Choice, Literal, Repeat, Sequence, walk
from wayword.grammar.recognise import matches
from wayword.grammar.simplify import simplify
from wayword.grammar.trie import trie

words = st.lists(st.text("abé ", max_size=5), min_size=1, max_size=12)


@given(words, words)
def test_a_trie_holds_its_words_and_no_others(inside: list[str], others: list[str]) -> None:
    expression = trie(inside)
    for word in inside + others:
        assert matches({}, expression, word) == (word in inside)


@given(words)
def test_no_two_branches_of_a_trie_begin_alike(inside: list[str]) -> None:
    for part in walk(trie(inside)):
        if isinstance(part, Choice):
            firsts = [next(each for each in walk(branch) if isinstance(each, Literal)) for branch in part.alternatives]
            assert len({first.text[0] for first in firsts}) == len(firsts)


def test_a_trie_is_deterministic() -> None:
    expected = Sequence((Literal("un"), Choice((Literal("safe"), Literal("known")))))
    assert trie(["unsafe", "unknown"]) == expected
    assert trie(["lane", "lane_2"]) == Sequence((Literal("lane"), Repeat(Literal("_2"), 0, 1)))


GRAMMAR = """
start: _pair{NAME, colour} | _maybe start? | "x" "y"
_pair{a, b}: a "=" b
_maybe: ALIAS
ALIAS: NAME
NAME: "speed" | "speed_limit" | "state" | "eta" | "e" | /[0-9]/ | "z"
colour: "red" | "green" | "r"i
loop: loop2
loop2: loop
"""


def test_simplifying_keeps_the_language() -> None:
    grammar = load_text(GRAMMAR)
    simple = simplify(grammar)
    random = Random(1)
    for _ in range(300):
        text = generate(grammar, random, budget=30)
        assert is_sentence(simple, text), text
        assert is_sentence(grammar, generate(simple, random, budget=30))
        at = random.randrange(len(text))
        mutated = text[:at] + random.choice("est_=rgx0") + text[at + 1 :]
        assert is_sentence(simple, mutated) == is_sentence(grammar, mutated), mutated


def test_trivial_rules_are_inlined_and_others_kept() -> None:
    simple = simplify(load_text(GRAMMAR))
    assert list(simple.rules) == ["start", "NAME", "colour"]
    assert simplify(load_text("start: loop\nloop: other\nother: loop\n")).rules.keys() == {"start", "loop"}


def test_literals_and_characters_are_joined() -> None:
    simple = simplify(load_text('start: "a" "b" ("1" | "2" | /[x-z]/ | "long")\n'))
    body = simple.rules["start"].body
    assert isinstance(body, Sequence)
    assert body.items[0] == Literal("ab")
    assert isinstance(body.items[1], Choice)
    assert len(body.items[1].alternatives) == 2


def test_left_recursion_is_found_through_what_may_be_empty() -> None:
    rules = load_text(
        'start: a\na: empty b "x" | "y"\nb: other? a\nempty: hidden\nhidden: "h"*\nother: "o"\nright: "r" right?\n'
    ).rules
    assert nullable_rules(rules) == {"empty", "hidden"}
    assert left_recursions(rules) == [("a", "b")]
    assert left_recursions(load_text('start: "r" start | "e"\n').rules) == []


def test_nullable_repetition_is_found() -> None:
    rules = load_text('start: (a "x"?)+ a~0..3\na: "a"?\n').rules
    assert [rule.name for rule, _ in nullable_repetitions(rules)] == ["start"]


def test_rules_without_end_are_found() -> None:
    rules = load_text('start: "a" start | "b" ok\nok: "c" | never\nnever: "n" never\n').rules
    assert [rule.name for rule in unproductive_rules(rules)] == ["never"]


def test_specialisation_replaces_a_terminal() -> None:
    grammar = specialise(load_text("start: A B\nA: /a+/\nB: /b+/\n"), {"A": ["a", "aaa"], "B": ["bb"]})
    assert [text for text in ("abb", "aaabb", "aabb", "ab") if is_sentence(grammar, text)] == ["abb", "aaabb"]
    assert grammar.provenance[1:] == ("A: one of 2 names", "B: one of 1 names")


@pytest.mark.parametrize(
    ("names", "message"),
    [
        ({"TOWN": ["x"]}, "specialisation of TOWN: the grammar has no such terminal"),
        ({"command": ["x"]}, "specialisation of command: the grammar has no such terminal"),
        ({"PLACE": []}, "with no names nothing could stand in its place"),
        ({"PLACE": ["Home", "Zoo", "Home"]}, "'Home' is named twice"),
        ({"PLACE": ["1st Street"]}, "'1st Street' is not what the terminal matches"),
    ],
)
def test_specialisation_refuses(names: dict[str, list[str]], message: str) -> None:
    with pytest.raises(GrammarError, match=message):
        specialise(load(), names)


@pytest.mark.parametrize(
    "text",
    [
        'start: "(" start ")" | start start | "x"\n',
        'start: a\na: b b b\nb: a | "x" | "(" start ")"\n',
        'start: start "x" | never | "y"\nnever: "n" never\n',
        'start: (start*)~2..5 "x"\n',
        "start: /[^a]+/ /é|[à-ü]/\n",
    ],
)
def test_generation_always_ends(text: str) -> None:
    grammar = load_text(text)
    for seed in range(50):
        sentence = generate(grammar, Random(seed), budget=60)
        assert len(sentence) < 1_000
        assert sentence == generate(grammar, Random(seed), budget=60)
        sentence.encode()


def test_generation_refuses_a_grammar_without_sentences() -> None:
    with pytest.raises(GrammarError, match="it derives no finite text"):
        generate(load_text('start: "a" start\n'), Random(0))
