"""Among other cars: nobody collides, gaps are safe, and everything can be repeated."""

import hashlib
import random
import subprocess
import sys

import pytest

from tests.unit.world.helpers import drive, manoeuvre
from wayword.runtime.vehicle import OperationMode
from wayword.runtime.world import Placement, World
from wayword.runtime.world.lane_change import gap_is_safe
from wayword.runtime.world.traffic import TrafficCar

FINGERPRINT = """
import hashlib
from wayword.runtime.world import World
world = World(seed=5, vehicles=12, start="Home", destination="Hospital")
world.vehicle.start()
digest = hashlib.sha256()
for _ in range(300):
    world.step()
    state = world.vehicle.state()
    digest.update(repr((state.x_m, state.y_m, state.speed_mps, world.others())).encode())
print(digest.hexdigest())
"""


def _fingerprint() -> str:
    world = World(seed=5, vehicles=12, start="Home", destination="Hospital")
    world.vehicle.start()
    digest = hashlib.sha256()
    for _ in range(300):
        world.step()
        state = world.vehicle.state()
        digest.update(repr((state.x_m, state.y_m, state.speed_mps, world.others())).encode())
    return digest.hexdigest()


def test_the_same_seed_gives_the_same_trajectory_in_any_process() -> None:
    first = _fingerprint()
    assert _fingerprint() == first
    other = subprocess.run([sys.executable, "-c", FINGERPRINT], check=True, capture_output=True, text=True)
    assert other.stdout.strip() == first


@pytest.mark.parametrize("seed", range(4))
def test_long_trips_in_traffic_are_safe(seed: int) -> None:
    world = World(seed=seed, vehicles=20)
    vehicle, passenger = world.vehicle, random.Random(seed)
    arrivals = 0
    while world.time_s < 300.0:
        if vehicle.mode is OperationMode.PARKED:
            arrivals += vehicle.has_arrived()
            vehicle.set_destination(passenger.choice(vehicle.places))
            vehicle.start()
        if passenger.random() < 0.01:
            vehicle.request_turn(passenger.choice(("left", "right", "straight")))
            vehicle.request_lane_change(passenger.choice(("left", "right")))
        world.step()
    monitor = world.monitor
    assert (monitor.collisions, monitor.collisions_of_others, monitor.red_lights_run) == (0, 0, 0)


def test_others_pass_a_parked_car() -> None:
    world = World(seed=3, vehicles=0, start=Placement("B1", "B2", 110))
    env = world.environment
    lane = env.scene.network.links["B1>B2"].lanes[1]
    other = TrafficCar(env.road, env.scene, lane, 2.0, 8.0, env.np_random, 0)
    env.road.vehicles.append(other)
    assert drive(world, 40, lambda: other.segment.link is lane.link and other.s > world.vehicle.s + 8.0)
    assert world.monitor.collisions == 0


def _beside(distance: float, speed: float, other_speed: float) -> tuple[World, TrafficCar]:
    """The ego in the right lane, another car in the left one, `distance` metres further back."""
    world = World(vehicles=0, start=Placement("B1", "B2", 100), destination="Hospital")
    env = world.environment
    lane = env.scene.network.links["B1>B2"].lanes[0]
    other = TrafficCar(env.road, env.scene, lane, world.vehicle.s - distance, other_speed, env.np_random, 0)
    env.road.vehicles.append(other)
    world.vehicle.speed = speed
    env.scene.occupancy.rebuild(env.road.vehicles)
    return world, other


@pytest.mark.parametrize(
    ("distance", "other_speed", "safe"),
    # at 5 m/s each: 5 m; 6 m/s faster from behind: 2.4 + 6 + 5 = 13.4 m; bumper to bumper is 5 m less
    [(9.0, 5.0, False), (11.0, 5.0, True), (17.0, 11.0, False), (19.5, 11.0, True), (0.0, 5.0, False)],
)
def test_the_gap_to_a_car_behind_follows_un_r79(distance: float, other_speed: float, safe: bool) -> None:
    world, other = _beside(distance, 5.0, other_speed)
    assert gap_is_safe(world.vehicle, other.segment) is safe


def test_a_lane_change_waits_for_the_gap() -> None:
    world, _ = _beside(2.0, 4.0, 4.0)
    vehicle = world.vehicle
    vehicle.set_parameter("max_vel", 4.0)
    vehicle.start()
    change = manoeuvre(vehicle.request_lane_change("left"))
    drive(world, 40, lambda: change.state != "running")
    assert world.monitor.collisions == 0
