"""How the car moves: along its lane, in comfort, and within its limits."""

import math
from itertools import pairwise

import pytest

from tests.unit.world.helpers import arrive, drive, manoeuvre
from wayword.runtime.vehicle import ManoeuvreState, OperationMode
from wayword.runtime.world import Placement, World

TRIPS = [("Home", "Main Station"), ("Museum", "Stadium"), ("Campus Building", "Harbor")]


@pytest.mark.parametrize(("start", "goal"), TRIPS)
def test_the_car_keeps_its_lane_and_drives_in_comfort(start: str, goal: str) -> None:
    world = World(vehicles=0, start=start, destination=goal)
    vehicle = world.vehicle
    vehicle.start()
    offsets, lateral, speeds, accelerations = [], [], [], []

    def watch() -> bool:
        state = vehicle.state()
        if vehicle.shift is None:
            offsets.append(abs(vehicle.offset))
        lateral.append(abs(state.lateral_acceleration_mps2))
        speeds.append(state.speed_mps)
        accelerations.append(state.acceleration_mps2)
        assert state.speed_mps <= 50 / 3.6 + 0.1
        return vehicle.mode is OperationMode.PARKED and vehicle.has_arrived()

    assert drive(world, 400, watch)
    assert max(offsets) < 0.5
    assert max(lateral) <= vehicle.parameters.max_lat_accel * 1.05
    assert max(accelerations) <= vehicle.parameters.max_accel + 1e-6
    assert min(accelerations) >= -vehicle.parameters.max_decel * 1.25
    # at the very end of a stop the braking ends at once, because the car stands
    moving = [speed > 0.5 for speed in speeds]
    changes = [abs(b - a) for a, b in pairwise(accelerations)]
    jerks = [change / 0.2 for change, *both in zip(changes, moving, moving[1:], strict=False) if all(both)]
    assert max(jerks) <= 3.0 + 1e-6


@pytest.mark.parametrize("place", ["Library", "Museum", "Stadium"])
def test_it_parks_at_the_place(place: str) -> None:
    world = World(vehicles=0, start="Home", destination=place)
    world.vehicle.start()
    assert arrive(world)
    state = world.vehicle.state()
    assert math.dist((state.x_m, state.y_m), world.map.outline().places[place]) < 1.0
    assert state.remaining_distance_m == pytest.approx(0.0, abs=1.0)
    assert (state.next_manoeuvre, state.next_manoeuvre_place) == ("arrive", place)
    assert state.binding.constraint == "parked"
    assert not drive(world, 5, lambda: world.vehicle.state().speed_mps > 0.0)


def test_the_lower_limit_of_a_side_street_is_kept_from_its_beginning() -> None:
    world = World(vehicles=0, start=Placement("B1", "B2", 60, lane=1), destination="Library")
    vehicle = world.vehicle
    vehicle.set_destination("Campus Building")
    vehicle.start()
    manoeuvre(vehicle.request_turn("left"))
    assert drive(world, 120, lambda: vehicle.state().road == "Church Street")
    assert vehicle.state().speed_limit_mps == pytest.approx(30 / 3.6)
    assert not drive(world, 20, lambda: vehicle.state().road == "Church Street" and vehicle.speed > 30 / 3.6 + 0.1)


@pytest.mark.parametrize("kmh", [10.0, 30.0])
def test_max_vel_takes_effect_with_comfortable_braking(kmh: float) -> None:
    world = World(vehicles=0, start="Home", destination="Hospital")
    vehicle = world.vehicle
    vehicle.start()
    assert drive(world, 60, lambda: vehicle.speed > 11.0)
    assert vehicle.set_parameter("max_vel", kmh / 3.6) is None
    hardest = []
    drive(world, 6, lambda: bool(hardest.append(vehicle.state().acceleration_mps2)))  # type: ignore[func-returns-value]
    assert min(hardest) >= -vehicle.parameters.max_decel * 1.25
    assert not drive(world, 60, lambda: vehicle.speed > kmh / 3.6 + 0.5)
    assert vehicle.status().settings == {"max_vel": f"{kmh:g} km/h"}
    assert vehicle.settings()["max_vel"] == pytest.approx(kmh / 3.6)


def test_stop_is_comfortable_holds_and_keeps_the_route() -> None:
    world = World(vehicles=0, start="Home", destination="Hospital")
    vehicle = world.vehicle
    vehicle.start()
    assert drive(world, 60, lambda: vehicle.speed > 8.0)
    vehicle.stop()
    world.step()
    assert vehicle.state().mode is OperationMode.STOPPING
    decelerations = []

    def parked() -> bool:
        decelerations.append(-vehicle.state().acceleration_mps2)
        return vehicle.mode is OperationMode.PARKED

    assert drive(world, 20, parked)
    assert max(decelerations) <= vehicle.parameters.max_decel + 1e-6
    position = vehicle.state().y_m
    drive(world, 3)
    assert vehicle.state().y_m == pytest.approx(position, abs=0.05)
    assert vehicle.state().destination == "Hospital"
    assert vehicle.start() is None
    assert drive(world, 10, lambda: vehicle.speed > 3.0)


def test_stop_does_not_end_inside_a_junction() -> None:
    world = World(vehicles=0, seed=1, start="Home", destination="Hospital")
    vehicle = world.vehicle
    vehicle.start()
    assert drive(world, 120, lambda: vehicle.connector_entered() is not None)
    vehicle.stop()
    assert drive(world, 30, lambda: vehicle.mode is OperationMode.PARKED)
    assert vehicle.connector_entered() is None
    assert vehicle.state().lane is not None


def test_emergency_stop_brakes_at_once_and_hard() -> None:
    world = World(vehicles=0, start="Home", destination="Hospital")
    vehicle = world.vehicle
    vehicle.start()
    assert drive(world, 60, lambda: vehicle.speed > 9.0)
    speed = vehicle.speed
    assert vehicle.emergency_stop() is None
    world.step()
    assert vehicle.state().acceleration_mps2 == pytest.approx(-8.0)
    assert vehicle.state().binding.constraint == "emergency"
    assert drive(world, speed / 8.0 + 0.4, lambda: vehicle.mode is OperationMode.PARKED)
    assert vehicle.start() is None
    assert drive(world, 10, lambda: vehicle.speed > 3.0)


def test_a_lane_change_goes_exactly_one_lane_after_blinking() -> None:
    world = World(vehicles=0, start="Museum", destination="Harbor")
    vehicle = world.vehicle
    vehicle.set_parameter("max_vel", 20 / 3.6)
    vehicle.start()
    assert drive(world, 120, lambda: vehicle.state().road == "Church Street" and vehicle.front > 20)
    drive(world, 1)
    lane = vehicle.state().lane
    side, other = ("left", 1) if lane == 2 else ("right", 2)
    begun = world.time_s
    change = manoeuvre(vehicle.request_lane_change(side))  # type: ignore[arg-type]
    assert drive(world, 20, lambda: vehicle.shift is not None)
    assert world.time_s - begun >= 3.0
    assert vehicle.state().indicator == side
    assert drive(world, 6, lambda: change.state is ManoeuvreState.DONE)
    assert vehicle.state().lane == other
    assert abs(vehicle.offset) < 0.3


def test_stop_during_a_lane_change_ends_in_a_lane() -> None:
    world = World(vehicles=0, start=Placement("B1", "B2", 40), destination="Hospital")
    vehicle = world.vehicle
    vehicle.set_parameter("max_vel", 20 / 3.6)
    vehicle.start()
    drive(world, 2)
    change = manoeuvre(vehicle.request_lane_change("left"))
    assert drive(world, 20, lambda: vehicle.shift is not None and vehicle.shift.progress > 0.3)
    vehicle.stop()
    assert drive(world, 20, lambda: vehicle.mode is OperationMode.PARKED)
    world.step()
    assert change.state is ManoeuvreState.DONE
    assert vehicle.state().lane == 1
    assert abs(vehicle.offset) < 0.3
