"""Every command ends in exactly one outcome, and the right one."""

import pytest

from tests.programs import join, program
from tests.unit.runtime.scripted_vehicle import SUPPORTED, ScriptedVehicle
from wayword.compiler import compile_program
from wayword.compiler.vocabulary import ACTIONS
from wayword.runtime.executor import Executor, ProgramRun
from wayword.runtime.feedback import feedback
from wayword.runtime.outcome import Outcome
from wayword.runtime.vehicle import ManoeuvreState, OperationMode, Refusal

SAMPLES = {
    "QUERY": program("QUERY", item="speed"),
    "SET_DESTINATION": program("SET_DESTINATION", destination="Home"),
    "ADD_WAYPOINT": program("ADD_WAYPOINT", waypoint="Home"),
    "SET_PARAM": program("SET_PARAM", max_vel="30 km/h"),
    "ADJUST_PARAM": program("ADJUST_PARAM", max_vel="increase"),
    "CHANGE_LANE": program("CHANGE_LANE", direction="right"),
    "TURN": program("TURN", direction="straight"),
    "TAKE_EXIT": program("TAKE_EXIT", number="1"),
    "OVERRIDE_TRAFFIC_LIGHT": program("OVERRIDE_TRAFFIC_LIGHT", state="green"),
    "OVERRIDE_SPEED_LIMIT": program("OVERRIDE_SPEED_LIMIT", limit="50 km/h"),
    "IGNORE_OBJECT": program("IGNORE_OBJECT", position="ahead"),
    "REPORT_OBJECT": program("REPORT_OBJECT", position="ahead"),
    "REJECT": program("REJECT", reason="unsafe"),
    "CLARIFY": program("CLARIFY", about="direction"),
}


def submit(executor: Executor, source: str) -> ProgramRun:
    result = compile_program(source, executor.vehicle.places)
    assert result.ok
    return executor.submit(result.commands)


def outcomes(run: ProgramRun) -> list[tuple[Outcome, str | None]]:
    return [(report.outcome, report.rationale) for report in run.reports]


@pytest.mark.parametrize("action", sorted(set(ACTIONS) - SUPPORTED))
def test_what_the_vehicle_does_not_support_is_refused_and_said(action: str) -> None:
    vehicle = ScriptedVehicle()
    run = submit(Executor(vehicle), SAMPLES.get(action, program(action)))
    assert outcomes(run) == [(Outcome.REFUSED, "not_supported")]
    assert vehicle.calls == []
    assert "not yet supported by this vehicle" in feedback(run.reports)


def test_an_unknown_instruction_is_refused_even_for_a_supported_action() -> None:
    class Eager(ScriptedVehicle):
        @property
        def actions(self) -> frozenset[str]:
            return frozenset(ACTIONS)

    vehicle = Eager()
    run = submit(Executor(vehicle), program("PULL_OVER"))
    assert outcomes(run) == [(Outcome.REFUSED, "not_supported")]
    assert vehicle.calls == []


def test_a_setting_that_the_vehicle_lacks_is_refused() -> None:
    vehicle = ScriptedVehicle()
    vehicle.refuses["set_parameter"] = Refusal("unsupported_parameter", {"parameter": "min_gap"})
    run = submit(Executor(vehicle), program("SET_PARAM", min_gap="3 m"))
    assert outcomes(run) == [(Outcome.REFUSED, "unsupported_parameter")]
    assert "not yet supported by this vehicle: setting gap at standstill" in feedback(run.reports)


@pytest.mark.parametrize(
    "source", [program("SET_PARAM", all="default"), program("SET_PARAM", following_distance="30 m")]
)
def test_a_setting_with_an_unknown_instruction_is_refused_by_its_name(source: str) -> None:
    run = submit(Executor(ScriptedVehicle()), source)
    assert outcomes(run) == [(Outcome.REFUSED, "unsupported_parameter")]
    assert "not yet supported by this vehicle: setting" in feedback(run.reports)


def test_set_max_vel_reaches_the_vehicle_in_si() -> None:
    vehicle = ScriptedVehicle()
    run = submit(Executor(vehicle), SAMPLES["SET_PARAM"])
    assert outcomes(run) == [(Outcome.SUCCEEDED, None)]
    ((_, name, value),) = vehicle.calls
    assert (name, value) == ("max_vel", pytest.approx(30 / 3.6))


@pytest.mark.parametrize(
    ("source", "rationale"),
    [(SAMPLES["TURN"], "not_under_way"), (SAMPLES["CHANGE_LANE"], "not_under_way")],
)
def test_manoeuvres_need_a_car_under_way(source: str, rationale: str) -> None:
    vehicle = ScriptedVehicle(mode=OperationMode.PARKED)
    assert outcomes(submit(Executor(vehicle), source)) == [(Outcome.REFUSED, rationale)]
    assert vehicle.calls == []


def test_preconditions() -> None:
    executor = Executor(ScriptedVehicle(destination=None, traffic_light=None, mode=OperationMode.PARKED))
    assert outcomes(submit(executor, program("START"))) == [(Outcome.REFUSED, "no_destination")]
    assert outcomes(submit(executor, SAMPLES["OVERRIDE_TRAFFIC_LIGHT"])) == [(Outcome.REFUSED, "no_traffic_light")]


@pytest.mark.parametrize(("lane", "direction", "legal"), [(1, "left", False), (1, "right", True), (2, "right", False)])
def test_there_must_be_a_lane_to_change_to(lane: int, direction: str, legal: bool) -> None:
    run = submit(Executor(ScriptedVehicle(lane=lane)), program("CHANGE_LANE", direction=direction))
    assert outcomes(run) == ([] if legal else [(Outcome.REFUSED, "no_such_lane")])


def test_a_turn_waits_until_it_is_done() -> None:
    vehicle = ScriptedVehicle()
    executor = Executor(vehicle)
    run = submit(executor, SAMPLES["TURN"])
    vehicle.wait(20.0)
    executor.step()
    assert not run.done
    assert vehicle.manoeuvre is not None
    vehicle.manoeuvre.state = ManoeuvreState.DONE
    executor.step()
    (report,) = run.reports
    assert report.outcome is Outcome.SUCCEEDED
    assert (report.started_s, report.ended_s) == (0.0, 20.0)
    assert feedback(run.reports) == "We went straight on at the junction."


def test_a_failed_manoeuvre_tells_why() -> None:
    vehicle = ScriptedVehicle()
    executor = Executor(vehicle)
    run = submit(executor, SAMPLES["CHANGE_LANE"])
    assert vehicle.manoeuvre is not None
    vehicle.manoeuvre.state, vehicle.manoeuvre.refusal = ManoeuvreState.FAILED, Refusal("no_gap")
    executor.step()
    assert outcomes(run) == [(Outcome.FAILED, "no_gap")]
    assert "no safe gap" in feedback(run.reports)


def test_what_takes_too_long_times_out_and_is_called_off() -> None:
    vehicle = ScriptedVehicle()
    executor = Executor(vehicle)
    run = submit(executor, SAMPLES["CHANGE_LANE"])
    vehicle.wait(60.0)
    executor.step()
    assert not run.done
    vehicle.wait(0.2)
    executor.step()
    assert outcomes(run) == [(Outcome.TIMED_OUT, "timeout")]
    assert vehicle.cancelled == [vehicle.manoeuvre]


def test_a_newer_turn_supersedes_the_older_one_only() -> None:
    vehicle = ScriptedVehicle()
    executor = Executor(vehicle)
    lane_change = submit(executor, SAMPLES["CHANGE_LANE"])
    older = submit(executor, SAMPLES["TURN"])
    newer = submit(executor, program("TURN", direction="left"))
    assert outcomes(older) == [(Outcome.SUPERSEDED, "superseded")]
    assert not newer.done
    assert not lane_change.done


def test_a_refused_command_supersedes_nothing() -> None:
    vehicle = ScriptedVehicle()
    executor = Executor(vehicle)
    older = submit(executor, SAMPLES["TURN"])
    vehicle.refuses["request_turn"] = Refusal("turn_not_possible", {"direction": "left"})
    newer = submit(executor, program("TURN", direction="left"))
    assert outcomes(newer) == [(Outcome.REFUSED, "turn_not_possible")]
    assert not older.done


def test_emergency_stop_supersedes_everything() -> None:
    vehicle = ScriptedVehicle()
    executor = Executor(vehicle)
    runs = [submit(executor, SAMPLES["TURN"]), submit(executor, SAMPLES["CHANGE_LANE"])]
    stop = submit(executor, program("EMERGENCY_STOP"))
    assert all(outcomes(run) == [(Outcome.SUPERSEDED, "superseded")] for run in runs)
    vehicle.set(mode=OperationMode.PARKED, speed_mps=0.0)
    executor.step()
    assert outcomes(stop) == [(Outcome.SUCCEEDED, None)]


def test_a_lane_change_that_cannot_be_called_off_any_more_ends_as_it_really_does() -> None:
    vehicle = ScriptedVehicle()
    executor = Executor(vehicle)
    change = submit(executor, SAMPLES["CHANGE_LANE"])
    vehicle.too_late_to_cancel = True
    submit(executor, program("STOP"))
    assert not change.done
    assert vehicle.manoeuvre is not None
    vehicle.manoeuvre.state = ManoeuvreState.DONE
    executor.step()
    assert outcomes(change) == [(Outcome.SUCCEEDED, None)]


def test_a_refused_start_leaves_the_emergency_stop_alone() -> None:
    vehicle = ScriptedVehicle()
    executor = Executor(vehicle)
    stop = submit(executor, program("EMERGENCY_STOP"))
    vehicle.refuses["start"] = Refusal("emergency_braking")
    assert outcomes(submit(executor, program("START"))) == [(Outcome.REFUSED, "emergency_braking")]
    assert vehicle.now.mode is OperationMode.EMERGENCY
    assert not stop.done


def test_a_question_is_answered_while_a_turn_waits() -> None:
    executor = Executor(ScriptedVehicle())
    turn = submit(executor, SAMPLES["TURN"])
    question = submit(executor, SAMPLES["QUERY"])
    assert outcomes(question) == [(Outcome.SUCCEEDED, None)]
    assert not turn.done


def test_the_next_command_starts_when_the_one_before_has_succeeded() -> None:
    vehicle = ScriptedVehicle()
    executor = Executor(vehicle)
    run = submit(executor, join(SAMPLES["TURN"], program("STOP")))
    assert [call[0] for call in vehicle.calls] == ["request_turn"]
    assert vehicle.manoeuvre is not None
    vehicle.manoeuvre.state = ManoeuvreState.DONE
    executor.step()
    assert [call[0] for call in vehicle.calls] == ["request_turn", "stop"]
    vehicle.set(mode=OperationMode.PARKED)
    executor.step()
    assert [outcome for outcome, _ in outcomes(run)] == [Outcome.SUCCEEDED, Outcome.SUCCEEDED]


def test_after_a_failure_the_rest_is_not_started_and_the_passenger_hears_so() -> None:
    vehicle = ScriptedVehicle()
    run = submit(Executor(vehicle), join(program("PULL_OVER"), program("STOP"), SAMPLES["QUERY"]))
    assert outcomes(run) == [
        (Outcome.REFUSED, "not_supported"),
        (Outcome.CANCELLED, "earlier_command_failed"),
        (Outcome.CANCELLED, "earlier_command_failed"),
    ]
    assert vehicle.calls == []
    assert "I left out the rest: stopping and your question." in feedback(run.reports)


@pytest.mark.parametrize(
    ("reason", "goes_on"), [("unrelated", True), ("unsupported", True), ("unsafe", False), ("unknown_place", False)]
)
def test_which_rejections_end_a_program(reason: str, goes_on: bool) -> None:
    run = submit(Executor(ScriptedVehicle()), join(program("REJECT", reason=reason), SAMPLES["QUERY"]))
    assert run.reports[0].rationale == f"reject_{reason}"
    assert run.reports[1].outcome is (Outcome.SUCCEEDED if goes_on else Outcome.CANCELLED)


def test_a_question_back_ends_a_program() -> None:
    run = submit(Executor(ScriptedVehicle()), join(SAMPLES["CLARIFY"], SAMPLES["QUERY"]))
    assert [outcome for outcome, _ in outcomes(run)] == [Outcome.REFUSED, Outcome.CANCELLED]
    assert feedback(run.reports).startswith("To the left or to the right?")
