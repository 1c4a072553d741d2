"""The Wayword grammar: Lark's parser, llama.cpp under the emitted GBNF and the definition agree on what it allows."""

import re
from random import Random
from typing import Protocol

import pytest
from lark import Lark
from lark.exceptions import UnexpectedInput

from wayword.grammar import (
    GrammarError,
    constraint,
    generate,
    is_sentence,
    load,
    parser,
    specialise,
    to_gbnf,
    wayword_lark,
)


class Engine(Protocol):
    def accepts(self, gbnf: str, text: str, *, by_character: bool = False) -> bool: ...


ALPHABET = "abdeilmnorst_ACEMNPRST-+:./^ 0123456789\n"


def parses(lark: Lark, text: str) -> bool:
    try:
        lark.parse(text)
    except UnexpectedInput:
        return False
    return True


@pytest.fixture(scope="module")
def gbnf(town: tuple[str, ...]) -> str:
    return constraint(town)


@pytest.fixture(scope="module")
def town_parser(town: tuple[str, ...]) -> Lark:
    """Lark's parser of the language with the town's places alone."""
    places = " | ".join(f'"{place}"' for place in town)
    return Lark(f"{wayword_lark()}\n%override PLACE: {places}\n", parser="lalr")


def mutations(text: str, random: Random, count: int) -> list[str]:
    """Delete, insert or replace one character, at random places."""
    found: list[str] = []
    for _ in range(count):
        at, width = random.randrange(len(text) + 1), random.choice((0, 1, 1))
        inserted = random.choice(ALPHABET) if width == 0 or random.random() < 0.7 else ""
        found.append(text[:at] + inserted + text[at + width :])
    return found


def test_programs_are_accepted_by_all(
    programs: list[str], gbnf: str, llama: Engine, town_parser: Lark, town: tuple[str, ...]
) -> None:
    grammar = specialise(load(), {"PLACE": town})
    for program in programs:
        assert is_sentence(grammar, program), program
        assert parses(town_parser, program), program
        assert parses(parser(), program), program
        assert parses(parser("source"), program), program
        assert llama.accepts(gbnf, program), program
        assert llama.accepts(gbnf, program, by_character=True), program


def test_every_action_of_the_grammar_has_a_program(programs: list[str]) -> None:
    actions = {line.split()[1] for line in "".join(programs).splitlines() if line.startswith("action: ")}
    assert actions == set(re.findall(r'"action: ([A-Z_]+)\\n"', wayword_lark()))


def test_one_character_mutations_are_judged_alike(
    programs: list[str], gbnf: str, llama: Engine, town_parser: Lark, town: tuple[str, ...]
) -> None:
    random = Random(4)
    grammar = specialise(load(), {"PLACE": town})
    accepted = 0
    for program in programs:
        for text in mutations(program, random, 60):
            verdict = parses(town_parser, text)
            assert llama.accepts(gbnf, text) == verdict, text
            assert is_sentence(grammar, text) == verdict, text
            accepted += verdict
    assert accepted > 50, "some mutations, such as another digit, are programs again"


def test_generated_sentences_parse_and_are_accepted(gbnf: str, llama: Engine, town: tuple[str, ...]) -> None:
    random = Random(7)
    grammar = specialise(load(), {"PLACE": town})
    sentences = {generate(grammar, random) for _ in range(2_000)}
    for sentence in sentences:
        parser().parse(sentence)
        assert llama.accepts(gbnf, sentence), sentence
    assert len(sentences) > 1_000


def test_all_places_are_in_the_constraint_and_no_other(gbnf: str, llama: Engine, town: tuple[str, ...]) -> None:
    template = "command_type: MISSION\naction: SET_DESTINATION\nparameters:\n  - name: destination\n    value: {}\n"
    for place in town:
        assert llama.accepts(gbnf, template.format(place)), place
    for place in ("Airport", "Mein Station", "main station", "Home ", "Hom", "Libraryy", "Main", "default"):
        assert not llama.accepts(gbnf, template.format(place)), place


def test_five_thousand_places(llama: Engine) -> None:
    places = [f"{kind} {number}" for kind in ("Stop", "Street", "Square", "Gate", "Dock") for number in range(1000)]
    gbnf = constraint(places)
    program = "command_type: MISSION\naction: ADD_WAYPOINT\nparameters:\n  - name: waypoint\n    value: Square 987\n"
    assert llama.accepts(gbnf, program)
    assert not llama.accepts(gbnf, program.replace("987", "1987"))


def test_constraint_is_made_once_for_a_map(town: tuple[str, ...]) -> None:
    assert constraint(list(town)) is constraint(town)
    assert constraint(town) != constraint(town[:-1])


@pytest.mark.parametrize(
    ("places", "message"),
    [
        ([], "with no names"),
        (["Home", "Home"], "'Home' is named twice"),
        (["Home", "Line\nbreak"], "is not what the terminal matches"),
        (["Two  Spaces"], "is not what the terminal matches"),
        ([""], "is not what the terminal matches"),
    ],
)
def test_malformed_maps_are_refused(places: list[str], message: str) -> None:
    with pytest.raises(GrammarError, match=message) as caught:
        constraint(places)
    position = caught.value.diagnostics[0].position
    assert position is not None
    assert position.file == "wayword.lark"


def test_constraint_is_readable(gbnf: str) -> None:
    lines = gbnf.splitlines()
    assert lines[0] == "# Generated by wayword.grammar from wayword.lark, start rule start; PLACE: one of 10 names."
    assert lines[2] == 'root ::= command ("---\\n" command){0,3}'
    assert r'query ::= "action: QUERY\nparameters:\n  - name: item\n    value: " ITEM "\n"' in lines
    assert 'NUMBER ::= ("0" | [1-9] [0-9]{0,3}) ("." [0-9]{0,2} [1-9])?' in lines
    assert all(" ::= " in line for line in lines[2:])


def test_the_shape_of_written_programs_has_a_grammar_too(programs: list[str], llama: Engine) -> None:
    gbnf = to_gbnf(load("source"))
    for text in (programs[0], programs[0].replace("speed", "sped"), "---\n".join(programs[:6])):
        assert llama.accepts(gbnf, text)
        assert parses(parser("source"), text)


def test_trees_know_their_positions(programs: list[str]) -> None:
    tree = parser().parse(f"{programs[0]}---\n{programs[1]}")
    assert sorted(query.meta.line for query in tree.find_data("query")) == [2, 8]


def test_parsers_are_cached() -> None:
    assert parser() is parser()
    assert parser("source") is not parser()
