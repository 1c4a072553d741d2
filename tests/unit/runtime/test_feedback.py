"""What the passenger hears."""

from typing import get_args

import pytest

from tests.programs import program
from tests.unit.runtime.scripted_vehicle import ScriptedVehicle
from wayword.compiler import compile_program
from wayword.compiler.vocabulary import ACTIONS, DRIVING_PARAMETERS, QUERY_ITEMS, Choice
from wayword.runtime.executor import Executor
from wayword.runtime.feedback import _table, feedback, not_compiled
from wayword.runtime.vehicle import Binding, Constraint, OperationMode, Rationale

ANSWERS = [
    ("speed", {}, "We are driving 36 km/h."),
    ("speed", {"speed_mps": 0.0}, "We are standing still."),
    ("speed_limit", {}, "The speed limit here is 50 km/h."),
    ("destination", {}, "We are going to Harbor."),
    ("destination", {"waypoints": ("Home", "Museum")}, "We are going to Harbor by way of Home and Museum."),
    ("destination", {"destination": None}, "No destination is set."),
    ("eta", {}, "We will arrive at Harbor in about 2 minutes."),
    ("eta", {"eta_s": 41.0}, "We will arrive at Harbor in about 40 seconds."),
    ("eta", {"eta_s": None}, "No destination is set, so I can't tell when we arrive."),
    ("remaining_distance", {}, "It is 640 m to Harbor."),
    ("remaining_distance", {"remaining_distance_m": 1240.0}, "It is 1.2 km to Harbor."),
    ("position", {}, "We are on Main Street."),
    ("lane", {}, "We are in lane 1 of 2, counted from the left."),
    ("lane", {"lane": None, "lanes": None}, "We are inside a junction, where there are no lanes."),
    ("lead_gap", {}, "The car ahead is 24 m away and drives 34 km/h."),
    ("lead_gap", {"lead_gap_m": None}, "There is no car ahead of us within sight."),
    ("next_maneuver", {}, "In 60 m we go left at Market Square."),
    (
        "next_maneuver",
        {"next_manoeuvre": "arrive", "next_manoeuvre_place": "Harbor"},
        "In 60 m we arrive at Harbor.",
    ),
    ("traffic_light", {}, "I see a red light 60 m ahead."),
    ("traffic_light", {"traffic_light": None}, "I see no traffic light ahead."),
    ("operation_mode", {}, "I am driving by myself."),
    (
        "settings",
        {},
        "My settings are: maximum speed 50 km/h, following distance 1.8 s and driving style normal.",
    ),
    ("surroundings", {}, "Around us I see 2 cars: one ahead at 29 m and one on the right at 6 m."),
    ("surroundings", {"surroundings": ()}, "I see no other road users near us."),
    ("reason", {}, "Because the car ahead drives 34 km/h."),
    ("reason", {"binding": Binding("leader", {"leader_kmh": 0})}, "Because the car ahead is standing."),
    ("reason", {"binding": Binding("red_light")}, "Because the light ahead is red."),
]


@pytest.mark.parametrize(("item", "state", "expected"), ANSWERS)
def test_answers_come_from_the_state(item: str, state: dict[str, object], expected: str) -> None:
    vehicle = ScriptedVehicle(**state)
    run = Executor(vehicle).submit(compile_program(program("QUERY", item=item)).commands)
    assert feedback(run.reports) == expected


def test_every_item_is_answered() -> None:
    assert {item for item, _, _ in ANSWERS} == set(QUERY_ITEMS)


@pytest.mark.parametrize("mode", OperationMode)
def test_every_mode_has_a_sentence(mode: OperationMode) -> None:
    run = Executor(ScriptedVehicle(mode=mode)).submit(compile_program(program("QUERY", item="operation_mode")).commands)
    assert feedback(run.reports).endswith(".")


def test_every_rejection_and_question_has_a_sentence() -> None:
    for action in ("REJECT", "CLARIFY"):
        (parameter,) = ACTIONS[action].parameters
        assert isinstance(parameter.type, Choice)
        for option in parameter.type.options:
            source = program(action, **{parameter.name: option})
            run = Executor(ScriptedVehicle()).submit(compile_program(source).commands)
            assert feedback(run.reports)


def test_a_program_with_errors_is_explained() -> None:
    result = compile_program(program("SET_PARAM", max_vel="250 km/h"))
    assert not_compiled(result.diagnostics) == (
        "I can't do that: maximum speed is out of bounds: 250 km/h. 5 to 130 km/h are allowed"
    )


FEEDBACK = [
    ("START", {}, {}, "We are on our way to Harbor."),
    ("STOP", {}, {"mode": OperationMode.PARKED}, "We have stopped. The route is kept."),
    ("STOP", {}, {"mode": OperationMode.PARKED, "destination": None}, "We have stopped."),
    ("SET_DESTINATION", {"destination": "Home"}, {}, "Our destination is now Home."),
    (
        "SET_DESTINATION",
        {"destination": "Home"},
        {"mode": OperationMode.STOPPING},
        "Our destination is now Home. Say when we shall start.",
    ),
    ("SET_PARAM", {"max_vel": "50 km/h"}, {}, "The maximum speed is now 50 km/h."),
    (
        "SET_PARAM",
        {"max_vel": "70 km/h"},
        {},
        "The maximum speed is now 70 km/h, but the limit of 50 km/h here still binds.",
    ),
    (
        "SET_PARAM",
        {"max_vel": "70 km/h"},
        {"speed_limit_mps": 70 * 0.2777777777777},
        "The maximum speed is now 70 km/h.",
    ),
    ("SET_PARAM", {"following_distance": "2 s"}, {}, "Following distance is now 2 s."),
    ("OVERRIDE_TRAFFIC_LIGHT", {"state": "green"}, {}, "Thank you, I take the light as green now."),
    (
        "EMERGENCY_STOP",
        {},
        {"mode": OperationMode.PARKED, "speed_mps": 0.0},
        "We are standing already and stay here.",
    ),
    ("OVERTAKE", {}, {}, "That is not yet supported by this vehicle: overtaking."),
]


@pytest.mark.parametrize(("action", "parameters", "state", "expected"), FEEDBACK)
def test_feedback_says_what_happened(
    action: str, parameters: dict[str, str], state: dict[str, object], expected: str
) -> None:
    vehicle = ScriptedVehicle(**state)
    executor = Executor(vehicle)
    run = executor.submit(compile_program(program(action, **parameters)).commands)
    vehicle.set(**state)
    executor.step()
    assert feedback(run.reports) == expected


def test_every_rationale_has_a_sentence_and_every_sentence_a_rationale() -> None:
    told_by_their_outcome = {"timeout", "earlier_command_failed"}
    assert set(_table("refused")) | set(_table("failed")) == set(get_args(Rationale)) - told_by_their_outcome


def test_every_action_and_parameter_has_a_name_in_speech() -> None:
    assert set(_table("actions")) == set(ACTIONS)
    assert set(_table("parameters")) == {*DRIVING_PARAMETERS, "all"}


def test_every_constraint_of_the_planner_has_a_sentence() -> None:
    assert {key.split(".")[0] for key in _table("reasons")} == set(get_args(Constraint))
