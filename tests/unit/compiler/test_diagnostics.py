"""What is said about programs that are wrong: code, line, column, what was expected."""

import pytest

from tests.programs import join, program
from wayword.compiler import CODES, compile_program, render_all

TOWN = ("Main Station", "Harbor", "Home")

# source, (code, line, column) of every diagnostic, words that the first message or help must have
CASES = [
    ("", [("WW0102", 1, 1)], "command_type"),
    ("command_type: MISSION\n", [("WW0102", 1, 22)], "action"),
    ("hello\n", [("WW0101", 1, 1)], "command_type"),
    ("command_type: MISSION\nactoin: START\n", [("WW0101", 2, 1)], "action"),
    (program("START") + "# done\n", [("WW0101", 3, 1)], "comments"),
    (program("TURN", direction="left").replace("  - name", "\t- name"), [("WW0101", 4, 1)], "two spaces"),
    (join(*[program("START")] * 5), [("WW0103", 13, 15)], "at most 4"),
    ("command_type: MISION\naction: START\n", [("WW0201", 1, 15)], "did you mean `MISSION`"),
    ("command_type: MISSION\naction: STAR\n", [("WW0202", 2, 9)], "did you mean `START`"),
    ("command_type: CONFIG\naction: START\n", [("WW0203", 1, 15)], "command_type: MISSION"),
    (program("TURN", way="left"), [("WW0204", 4, 11), ("WW0205", 2, 9)], "direction"),
    (program("START", at="noon"), [("WW0204", 4, 11)], "takes no parameters"),
    (program("SET_PARAM", max_val="50 km/h"), [("WW0204", 4, 11)], "did you mean `max_vel`"),
    (program("TURN"), [("WW0205", 2, 9)], "left | right | straight | around"),
    (program("SET_PARAM"), [("WW0205", 2, 9)], "max_vel"),
    (
        program("TURN", direction="left") + "  - name: direction\n    value: right\n",
        [("WW0206", 6, 11)],
        "twice",
    ),
    (program("SET_PARAM", max_vel="50 km/h", min_gap="2 m"), [("WW0207", 6, 11)], "exactly one"),
    (program("TURN", direction="up"), [("WW0304", 5, 12)], "left, right, straight, around"),
    (program("SET_PARAM", all="calm"), [("WW0304", 5, 12)], "default"),
    (program("SET_DESTINATION", destination="Harbour"), [("WW0401", 5, 12)], "did you mean `Harbor`"),
    (program("SET_DESTINATION", destination="9 Lives"), [("WW0402", 5, 12)], "name of a place"),
    (program("SET_PARAM", max_vel="250 km/h"), [("WW0303", 5, 12)], "5 to 130 km/h"),
    ("command_type: MISSION\naction: START \n", [("WW0202", 2, 9)], "white space"),
    ("command_type: MISSION\naction: START\n\n", [("WW0101", 3, 1)], "empty line"),
]


@pytest.mark.parametrize(("source", "expected", "words"), CASES)
def test_diagnostic(source: str, expected: list[tuple[str, int, int]], words: str) -> None:
    result = compile_program(source, TOWN)
    found = [(d.code.name, d.span.line, d.span.column) for d in result.diagnostics]
    assert found == expected
    assert not result.ok
    assert not result.commands
    assert words in f"{result.diagnostics[0].message} {result.diagnostics[0].help}"


def test_mistakes_in_several_commands_are_all_reported() -> None:
    source = join(program("TURN", direction="up"), program("SET_PARAM", max_vel="1 km/h"))
    assert [d.span.line for d in compile_program(source).diagnostics] == [5, 11]


def test_rendered_with_the_source_line_and_carets() -> None:
    source = program("SET_PARAM", max_vel="250 km/h")
    assert render_all(compile_program(source).diagnostics, source, "trip.yaml").split("\n") == [
        "error[WW0303]: max_vel is out of bounds: 250 km/h",
        " --> trip.yaml:5:12",
        "  |",
        "5 |     value: 250 km/h",
        "  |            ^^^^^^^^",
        "  = help: 5 to 130 km/h are allowed",
    ]


@pytest.mark.parametrize("word", ["Yes", "no", "on", "True", "null", "default"])
def test_words_of_yaml_are_no_places_whatever_the_map(word: str) -> None:
    source = program("SET_DESTINATION", destination=word)
    assert [d.code.name for d in compile_program(source).diagnostics] == ["WW0402"]


def test_control_characters_do_not_reach_the_terminal() -> None:
    source = "command_type: MISSION\naction: ST\x1b[2JART\n"
    rendered = render_all(compile_program(source).diagnostics, source)
    assert "\x1b" not in rendered
    assert "ST\ufffd[2JART" in rendered


def test_ten_thousand_bad_commands_do_not_make_ten_thousand_diagnostics() -> None:
    source = join(*["command_type: X\naction: Y\n"] * 10_000)
    assert len(compile_program(source).diagnostics) == 2 * 4 + 1


def test_without_a_map_any_well_formed_place_is_accepted() -> None:
    source = program("SET_DESTINATION", destination="Rosie's Diner No. 5")
    assert compile_program(source).ok
    assert not compile_program(source, TOWN).ok


def test_codes_are_well_formed_and_explained() -> None:
    assert all(name == code.name and name.startswith("WW") and len(name) == 6 for name, code in CODES.items())
    assert all(len(code.explanation) > 20 for code in CODES.values())
