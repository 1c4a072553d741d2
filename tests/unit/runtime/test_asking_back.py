"""The co-pilot asks back where the model is unsure, and acts where it is sure."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.fake_model import Answer, FakeModel
from tests.programs import join, program
from tests.unit.runtime.scripted_vehicle import ScriptedVehicle
from wayword.models import Translator
from wayword.models.confidence import ASK_BACK, ASK_BACK_BELOW
from wayword.runtime.copilot import CoPilot, Exchange
from wayword.runtime.outcome import Outcome
from wayword.runtime.recording import Event, Recorder, read_log

SLOW, LEFT, BRAKE = (
    program("SET_PARAM", max_vel="30 km/h"),
    program("TURN", direction="left"),
    program("EMERGENCY_STOP"),
)
UNSURE, SURE = ASK_BACK_BELOW / 2, (1 + ASK_BACK_BELOW) / 2


@pytest.fixture
def vehicle() -> ScriptedVehicle:
    return ScriptedVehicle()


@pytest.fixture
def recorder(tmp_path: Path) -> Iterator[Recorder]:
    with Recorder(tmp_path / "log.jsonl") as recorder:
        yield recorder


def say(vehicle: ScriptedVehicle, recorder: Recorder, model: FakeModel, words: str = "Well.") -> Exchange:
    copilot = CoPilot(vehicle, recorder)
    exchange = copilot.begin("t1", words)
    copilot.translate(exchange, Translator(model, vehicle.places))
    copilot.execute(exchange, exchange.program)
    return exchange


def answering(source: str, confidence: float) -> FakeModel:
    return FakeModel({"Well.": Answer(source, confidence)})


def logged(recorder: Recorder, kind: str) -> Event:
    (event,) = (event for event in read_log(recorder.path) if event["event"] == kind)
    return event


@pytest.mark.parametrize(
    "source",
    [SLOW, LEFT, program("STOP"), program("OVERRIDE_TRAFFIC_LIGHT", state="green"), join(LEFT, SLOW)],
)
def test_an_unsure_model_is_asked_back_for_and_nothing_changes(
    vehicle: ScriptedVehicle, recorder: Recorder, source: str
) -> None:
    before = vehicle.now
    exchange = say(vehicle, recorder, answering(source, UNSURE))
    assert vehicle.calls == []
    assert vehicle.now == before
    assert exchange.program == ASK_BACK
    assert exchange.run is not None
    (report,) = exchange.run.reports
    assert (report.command.action.name, report.outcome) == ("CLARIFY", Outcome.REFUSED)
    assert exchange.done
    assert exchange.feedback is not None
    assert exchange.feedback.endswith("?")


def test_the_log_says_so_and_keeps_what_the_model_said(vehicle: ScriptedVehicle, recorder: Recorder) -> None:
    exchange = say(vehicle, recorder, answering(SLOW, UNSURE))
    translation = logged(recorder, "translation")
    assert translation["asks_back"] is True
    assert translation["program"] == SLOW
    assert translation["confidence"] == pytest.approx(UNSURE, abs=1e-4)
    assert exchange.translation is not None
    assert exchange.translation.program == SLOW
    assert logged(recorder, "compilation")["program"] == ASK_BACK
    assert logged(recorder, "feedback")["text"] == exchange.feedback


@pytest.mark.parametrize("confidence", [SURE, ASK_BACK_BELOW + 1e-9])
def test_a_sure_model_is_acted_on(vehicle: ScriptedVehicle, recorder: Recorder, confidence: float) -> None:
    exchange = say(vehicle, recorder, answering(SLOW, confidence))
    assert exchange.program == SLOW
    assert vehicle.calls == [("set_parameter", "max_vel", pytest.approx(30 / 3.6))]
    assert logged(recorder, "translation")["asks_back"] is False


@pytest.mark.parametrize("source", [BRAKE, join(LEFT, BRAKE)])
def test_an_emergency_stop_is_executed_however_unsure_the_model(
    vehicle: ScriptedVehicle, recorder: Recorder, source: str
) -> None:
    exchange = say(vehicle, recorder, answering(source, 0.001))
    assert vehicle.calls == [("emergency_stop",)]
    assert exchange.program == BRAKE
    assert logged(recorder, "translation")["asks_back"] is False


def test_a_sure_model_s_commands_before_an_emergency_stop_are_run(vehicle: ScriptedVehicle, recorder: Recorder) -> None:
    say(vehicle, recorder, answering(join(SLOW, BRAKE), SURE))
    assert [call[0] for call in vehicle.calls] == ["set_parameter", "emergency_stop"]


def test_a_question_is_answered_however_unsure_the_model(vehicle: ScriptedVehicle, recorder: Recorder) -> None:
    exchange = say(vehicle, recorder, answering(program("QUERY", item="speed"), 0.001))
    assert exchange.feedback is not None
    assert "36" in exchange.feedback
    assert logged(recorder, "translation")["asks_back"] is False


def test_a_program_cut_off_changes_nothing(vehicle: ScriptedVehicle, recorder: Recorder) -> None:
    exchange = say(vehicle, recorder, FakeModel({"Well.": Answer(SLOW[:-14], SURE, finished=False)}))
    assert vehicle.calls == []
    assert exchange.run is None
    assert exchange.done


def test_an_instruction_that_can_not_be_read_changes_nothing(vehicle: ScriptedVehicle, recorder: Recorder) -> None:
    model = FakeModel()
    exchange = say(vehicle, recorder, model, "left " * 1000)
    assert model.asked == []
    assert vehicle.calls == []
    assert exchange.program is None
    assert exchange.translation_error is not None
    assert exchange.done
    assert "1000 are read" in str(logged(recorder, "translation_failed")["error"])


def test_a_doubtful_command_leaves_a_running_one_alone(vehicle: ScriptedVehicle, recorder: Recorder) -> None:
    model = FakeModel({"Left.": Answer(LEFT, SURE), "Hm.": Answer(program("TURN", direction="right"), UNSURE)})
    copilot, translator = CoPilot(vehicle, recorder), Translator(model, vehicle.places)
    exchanges = [copilot.begin("t1", "Left."), copilot.begin("t2", "Hm.")]
    for exchange in exchanges:
        copilot.translate(exchange, translator)
        copilot.execute(exchange, exchange.program)
    assert vehicle.calls == [("request_turn", "left")]
    assert [exchange.done for exchange in exchanges] == [False, True]
