"""What a program amounts to, and when two are the same."""

import pytest

from tests.programs import join, program
from tests.town import TOWN
from wayword.models.evaluation.judgement import Effect, effect, parses, same_program

FIFTY = program("SET_PARAM", max_vel="50 km/h")


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (FIFTY, FIFTY),
        (FIFTY, program("SET_PARAM", max_vel="50.0 km/h")),
        (FIFTY, FIFTY.removesuffix("\n")),
        (program("SET_PARAM", max_vel="36 km/h"), program("SET_PARAM", max_vel="10 m/s")),
    ],
)
def test_programs_that_compile_to_the_same_are_equal(one: str, other: str) -> None:
    assert same_program(one, other, TOWN)
    assert same_program(other, one, TOWN)


@pytest.mark.parametrize(
    "other",
    [
        program("SET_PARAM", max_vel="51 km/h"),
        program("ADJUST_PARAM", max_vel="+50 km/h"),
        join(FIFTY, program("START")),
        "Fifty it is.",
        "",
    ],
)
def test_other_programs_and_what_is_none_differ(other: str) -> None:
    assert not same_program(other, FIFTY, TOWN)
    assert not same_program(FIFTY, other, TOWN)


def test_the_order_of_commands_counts() -> None:
    left, start = program("CHANGE_LANE", direction="left"), program("START")
    assert not same_program(join(left, start), join(start, left), TOWN)


def test_programs_out_of_bounds_are_equal_by_their_text() -> None:
    fast = program("SET_PARAM", max_vel="250 km/h")
    assert same_program(fast, fast, TOWN)
    assert not same_program(fast, program("SET_PARAM", max_vel="251 km/h"), TOWN)
    assert not same_program(fast, FIFTY, TOWN)


def test_a_place_counts_only_on_its_map() -> None:
    there, shouted = (program("SET_DESTINATION", destination=place) for place in ("Harbor", "HARBOR"))
    assert not same_program(there, program("SET_DESTINATION", destination="Home"), TOWN)
    assert not same_program(there, shouted, ("Museum",))


@pytest.mark.parametrize(
    "source",
    [
        FIFTY,
        program("SET_PARAM", max_vel="250 km/h"),  # out of bounds
        program("SET_DESTINATION", destination="Atlantis"),  # not on the map
        join(FIFTY, program("START")),
    ],
)
def test_what_parses_may_still_be_refused(source: str) -> None:
    assert parses(source, TOWN)


@pytest.mark.parametrize("source", ["", "Sure, I will turn left!", FIFTY[:-12], join(*[FIFTY] * 5)])
def test_what_does_not_parse(source: str) -> None:
    assert not parses(source, TOWN)


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        (program("REJECT", reason="unrelated"), Effect.NONE),
        (program("CLARIFY", about="command"), Effect.NONE),
        (program("QUERY", item="speed"), Effect.ANSWER),
        (join(program("REJECT", reason="unsupported"), program("QUERY", item="speed")), Effect.ANSWER),
        (FIFTY, Effect.MOTION),
        (program("STOP"), Effect.MOTION),
        (program("SET_DESTINATION", destination="Home"), Effect.MOTION),
        (join(program("QUERY", item="speed"), program("START")), Effect.MOTION),
        (join(program("REJECT", reason="unsupported"), program("EMERGENCY_STOP")), Effect.MOTION),
        ("I am a language model.", Effect.NONE),
        ("", Effect.NONE),
    ],
)
def test_the_effect_is_that_of_the_command_that_does_most(source: str, expected: Effect) -> None:
    assert effect(source) is expected
