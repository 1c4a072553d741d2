"""When the co-pilot asks back instead of acting."""

import pytest

from tests.programs import join, program
from tests.town import TOWN
from wayword.compiler import compile_program
from wayword.compiler.vocabulary import ACTIONS
from wayword.models import Translation
from wayword.models.confidence import ASK_BACK, ASK_BACK_BELOW, asks_back, program_to_run

LEFT, BRAKE, QUERY = program("TURN", direction="left"), program("EMERGENCY_STOP"), program("QUERY", item="speed")
HARMLESS = (QUERY, program("REJECT", reason="unsafe"), program("CLARIFY", about="direction"))


def translation(source: str, confidence: float) -> Translation:
    return Translation(source, latency_ms=1.0, tokens=9, forced_tokens=0, confidence=confidence, finished=True)


def test_the_question_is_a_program() -> None:
    result = compile_program(ASK_BACK, TOWN)
    assert result.ok
    assert result.canonical == ASK_BACK == program("CLARIFY", about="command")


def test_the_threshold_is_a_probability() -> None:
    assert 0 < ASK_BACK_BELOW < 1


@pytest.mark.parametrize(("confidence", "asks"), [(0.0, True), (0.59, True), (0.6, False), (1.0, False)])
def test_it_acts_from_the_threshold_on(confidence: float, asks: bool) -> None:
    unsure = translation(LEFT, confidence)
    assert asks_back(unsure, 0.6) is asks
    assert program_to_run(unsure, 0.6) == (ASK_BACK if asks else LEFT)


def test_the_default_threshold() -> None:
    assert asks_back(translation(LEFT, ASK_BACK_BELOW - 0.01))
    assert not asks_back(translation(LEFT, ASK_BACK_BELOW))


@pytest.mark.parametrize("source", [*HARMLESS, join(*HARMLESS[1::-1]), ASK_BACK])
def test_what_does_no_harm_is_said_at_once(source: str) -> None:
    assert not asks_back(translation(source, 0.0))
    assert program_to_run(translation(source, 0.0)) == source


def test_every_action_that_does_something_is_held_back_but_the_emergency_stop() -> None:
    for action in set(ACTIONS) - {"QUERY", "REJECT", "CLARIFY", "EMERGENCY_STOP"}:
        assert asks_back(translation(program(action), 0.01)), action
        assert asks_back(translation(join(QUERY, program(action)), 0.01)), action


@pytest.mark.parametrize("confidence", [0.0, 0.01, 1.0])
def test_an_emergency_stop_is_never_held_back(confidence: float) -> None:
    stop = translation(BRAKE, confidence)
    assert not asks_back(stop)
    assert program_to_run(stop) == BRAKE
    assert compile_program(BRAKE, TOWN).canonical == BRAKE


@pytest.mark.parametrize("source", [join(LEFT, BRAKE), join(BRAKE, LEFT), join(QUERY, BRAKE)])
def test_a_doubtful_emergency_stop_waits_for_no_other_command(source: str) -> None:
    assert not asks_back(translation(source, 0.01))
    assert program_to_run(translation(source, 0.01)) == BRAKE
    assert program_to_run(translation(source, 0.99)) == source


@pytest.mark.parametrize("text", ["", "Sure, I'll do that.", "the action: EMERGENCY"])
def test_what_is_no_program_is_left_to_the_compiler(text: str) -> None:
    assert program_to_run(translation(text, 0.01)) == text
