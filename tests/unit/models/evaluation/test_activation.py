"""False activation as the co-pilot acts, and as the model alone would."""

import pytest

from tests.programs import join, program
from tests.unit.models.evaluation.results import result
from wayword.models.evaluation.activation import activation_summary

NOTHING = program("REJECT", reason="unrelated")
QUESTION = program("CLARIFY", about="command")
QUERY = program("QUERY", item="speed")
LEFT = program("TURN", direction="left")
BRAKE = program("EMERGENCY_STOP")


def test_the_rates_of_command_and_of_motion() -> None:
    report = activation_summary([result(NOTHING), result(QUESTION), result(QUERY), result(LEFT)])
    assert report["n"] == 4
    assert (report["activation_rate"], report["motion_rate"]) == (0.5, 0.25)
    assert report["translated"] == {"activation_rate": 0.5, "motion_rate": 0.25}
    assert [(case["got"], case["effect"]) for case in report["activations"]] == [(QUERY, "answer"), (LEFT, "motion")]


@pytest.mark.parametrize(("confidence", "moves"), [(0.59, 0.0), (0.6, 1.0), (0.61, 1.0)])
def test_below_the_threshold_the_copilot_asks_back(confidence: float, moves: float) -> None:
    report = activation_summary([result(LEFT, confidence=confidence)], threshold=0.6)
    assert (report["activation_rate"], report["motion_rate"]) == (moves, moves)
    assert report["translated"] == {"activation_rate": 1.0, "motion_rate": 1.0}
    assert len(report["activations"]) == moves


def test_an_answer_is_never_held_back() -> None:
    assert activation_summary([result(QUERY, confidence=0.01)])["activation_rate"] == 1.0


@pytest.mark.parametrize("got", [BRAKE, join(LEFT, BRAKE)])
def test_an_emergency_stop_is_never_held_back(got: str) -> None:
    report = activation_summary([result(got, confidence=0.0001)], threshold=1.0)
    assert report["motion_rate"] == 1.0


def test_what_is_no_program_or_was_not_read_does_nothing() -> None:
    report = activation_summary([result("Nice weather, indeed."), result("", confidence=0.0)])
    assert (report["activation_rate"], report["motion_rate"]) == (0.0, 0.0)


def test_each_tag_has_its_rates() -> None:
    report = activation_summary(
        [result(LEFT, tags=("talk",)), result(NOTHING, tags=("talk", "half")), result(QUERY, tags=("half",))]
    )
    assert report["by_tag"] == {
        "half": {"n": 2, "activation_rate": 0.5, "motion_rate": 0.0},
        "talk": {"n": 2, "activation_rate": 0.5, "motion_rate": 0.5},
    }


def test_nothing_evaluated_is_no_crash() -> None:
    report = activation_summary([])
    assert (report["n"], report["activation_rate"], report["activations"]) == (0, 0.0, [])
