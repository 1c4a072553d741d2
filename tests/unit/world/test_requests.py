"""What the passenger asks for: turns, lane changes, goals; and what is refused with which rationale."""

import pytest

from tests.unit.world.helpers import arrive, code, drive, manoeuvre
from wayword.runtime.vehicle import ManoeuvreState, OperationMode
from wayword.runtime.world import Fault, MapError, Placement, World


def _under_way(destination: str = "Hospital", **options: object) -> World:
    world = World(vehicles=0, start="Home", destination=destination, **options)  # type: ignore[arg-type]
    assert world.vehicle.start() is None
    drive(world, 2)
    return world


@pytest.mark.parametrize(
    ("start", "direction", "road"),
    [
        (Placement("B1", "B2", 60, lane=1), "left", "Church Street"),
        (Placement("B1", "B2", 60), "straight", "Main Street"),
        (Placement("B1", "B2", 60), "right", "Church Street"),
        (Placement("B1", "B2", 60), "left", "Church Street"),
        (Placement("B1", "B2", 60, lane=1), "right", "Church Street"),
    ],
)
def test_a_turn_is_taken_and_the_goal_is_still_reached(start: Placement, direction: str, road: str) -> None:
    world = World(vehicles=0, start=start, destination="Main Station")
    vehicle = world.vehicle
    vehicle.start()
    turn = manoeuvre(vehicle.request_turn(direction))  # type: ignore[arg-type]
    assert vehicle.state().next_manoeuvre == direction
    assert drive(world, 120, lambda: turn.state is not ManoeuvreState.RUNNING)
    assert turn.state is ManoeuvreState.DONE, turn
    assert vehicle.state().road == road
    assert vehicle.state().destination == "Main Station"
    assert arrive(world)


def test_a_turn_right_before_the_goal_passes_it_and_comes_back() -> None:
    world = World(vehicles=0, start=Placement("B3", "B2", 50), destination="City Hall")
    vehicle = world.vehicle
    vehicle.start()
    turn = manoeuvre(vehicle.request_turn("straight"))
    assert drive(world, 120, lambda: turn.state is ManoeuvreState.DONE)
    assert arrive(world, 500)


def test_an_emergency_stop_cannot_be_released_before_the_car_stands() -> None:
    world = _under_way()
    vehicle = world.vehicle
    drive(world, 4)
    vehicle.emergency_stop()
    assert code(vehicle.start()) == "emergency_braking"
    assert vehicle.stop() is None
    assert vehicle.state().mode is OperationMode.EMERGENCY
    assert drive(world, 10, lambda: vehicle.state().mode is OperationMode.PARKED)
    assert vehicle.start() is None


def test_a_second_turn_supersedes_the_first_and_cancelling_returns_to_the_route() -> None:
    world = _under_way()
    vehicle = world.vehicle
    first = manoeuvre(vehicle.request_turn("straight"))
    second = manoeuvre(vehicle.request_turn("right"))
    assert first.state is ManoeuvreState.FAILED
    assert code(first.refusal) == "superseded"
    vehicle.cancel(second)
    assert code(second.refusal) == "cancelled"
    assert vehicle.state().next_manoeuvre == "right"


def test_turns_are_refused_with_a_rationale() -> None:
    world = World(vehicles=0, start="Home", destination="Hospital")
    vehicle = world.vehicle
    assert code(vehicle.request_turn("right")) == "not_under_way"
    vehicle.start()
    assert code(vehicle.request_turn("around")) == "unsupported_turn"
    assert code(vehicle.request_turn("left")) == "turn_not_possible"
    assert drive(world, 150, lambda: (light := vehicle.state().traffic_light_distance_m) is not None and light < 3)
    assert vehicle.state().lane == 2
    drive(world, 1)
    if vehicle.connector_entered() is None:
        assert "straight" in vehicle.segment.connectors


def test_a_turn_that_comes_too_late_is_refused() -> None:
    world = World(vehicles=0, start=Placement("B1", "B2", 60), destination="Hospital")
    vehicle = world.vehicle
    vehicle.start()
    assert drive(world, 60, lambda: (vehicle.state().traffic_light_distance_m or 99.0) < 25.0)
    assert code(vehicle.request_turn("left")) == "too_close_to_junction"


def test_lane_changes_are_refused_with_a_rationale() -> None:
    world = World(vehicles=0, start=Placement("B1", "B2", 60), destination="Hospital")
    vehicle = world.vehicle
    assert code(vehicle.request_lane_change("left")) == "not_under_way"
    vehicle.start()
    drive(world, 1)
    assert code(vehicle.request_lane_change("right")) == "no_such_lane"
    assert drive(world, 60, lambda: (vehicle.state().traffic_light_distance_m or 99.0) < 15.0)
    assert code(vehicle.request_lane_change("left")) == "too_close_to_junction"


def test_goals_and_starting() -> None:
    world = World(vehicles=0, start="Home")
    vehicle = world.vehicle
    assert code(vehicle.start()) == "no_destination"
    assert code(vehicle.set_destination("Atlantis")) == "unknown_place"
    assert vehicle.set_destination("Library") is None
    assert vehicle.state().mode is OperationMode.PARKED
    assert vehicle.start() is None
    assert vehicle.start() is None
    assert vehicle.set_destination("Home") is None
    vehicle.emergency_stop()
    assert drive(world, 3, lambda: vehicle.mode is OperationMode.PARKED)
    assert code(vehicle.start()) == "already_there"


def test_a_goal_just_behind_is_reached_by_going_round() -> None:
    world = World(vehicles=0, start=Placement("C1", "B1", 120), destination="Home")
    state = world.vehicle.state()
    assert state.remaining_distance_m is not None
    assert state.remaining_distance_m > 300.0
    assert world.vehicle.start() is None
    assert arrive(world, 500)


@pytest.mark.parametrize("name", ["min_gap", "driving_style", "following_distance"])
def test_other_parameters_are_not_supported_yet(name: str) -> None:
    world = World(vehicles=0, start="Home")
    assert code(world.vehicle.set_parameter(name, 1.0)) == "unsupported_parameter"


def test_the_remaining_way_shrinks_and_the_eta_is_fair() -> None:
    world = _under_way("Main Station")
    vehicle = world.vehicle
    state = vehicle.state()
    assert state.eta_s is not None
    promised, began = state.eta_s, world.time_s
    last = [state.remaining_distance_m or 0.0]

    def arrived() -> bool:
        remaining = vehicle.state().remaining_distance_m
        assert remaining is not None
        assert remaining <= last[-1] + 0.5
        last.append(remaining)
        return vehicle.mode is OperationMode.PARKED

    assert drive(world, 400, arrived)
    assert 0.5 < (world.time_s - began) / promised < 2.0


def test_what_is_not_on_the_map_is_refused() -> None:
    with pytest.raises(MapError, match="Atlantis"):
        World(vehicles=0, start="Atlantis")
    with pytest.raises(MapError, match="Atlantis"):
        World(vehicles=0, destination="Atlantis")
    with pytest.raises(MapError, match="Z1"):
        World(vehicles=0, faults=[Fault("misread_light", "Z1", "red")])
    with pytest.raises(MapError, match="no lane 3"):
        World(vehicles=0, start=Placement("B1", "B2", 60, lane=3))
