"""What the passenger hears."""

from string import Formatter

import pytest

from tests.programs import program
from tests.unit.runtime.scripted_vehicle import ScriptedVehicle
from wayword.compiler import compile_program
from wayword.compiler.vocabulary import ACTIONS, QUERY_ITEMS, Choice
from wayword.runtime.executor import Executor
from wayword.runtime.feedback import _table, feedback, not_compiled
from wayword.runtime.vehicle import Binding, OperationMode

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
        "My settings are: max_vel 50 km/h, following_distance 1.8 s and driving_style normal.",
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
        "I can't do that: max_vel is out of bounds: 250 km/h. 5 to 130 km/h are allowed"
    )


def test_texts_are_well_formed() -> None:
    for table in ("answers", "modes", "reasons", "succeeded", "refused", "failed", "general"):
        for text in _table(table).values():
            assert list(Formatter().parse(text))
