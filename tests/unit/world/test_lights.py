"""Traffic lights: true ones, misread ones, and what the passenger says about them."""

import pytest

from tests.unit.world.helpers import code, drive
from wayword.runtime.world import Fault, Placement, World
from wayword.runtime.world.right_of_way import crossing_traffic_near, junction_demands, next_line
from wayword.runtime.world.traffic import TrafficCar

MISREAD = Fault("misread_light", "B1", "red")


def _waits_at_light(world: World) -> bool:
    light = world.true_light_ahead()
    return world.vehicle.speed == 0.0 and light is not None and light.distance_m < 2.0


def test_it_stops_before_a_red_light_and_goes_at_green() -> None:
    for seed in range(20):
        world = World(vehicles=0, seed=seed, start="Home", destination="Hospital")
        world.vehicle.start()
        if drive(world, 25, lambda w=world: _waits_at_light(w)):  # type: ignore[misc]
            break
    light = world.true_light_ahead()
    assert light is not None
    assert light.true_state == light.perceived_state == "red"
    assert 0.0 < light.distance_m < 2.0
    assert world.vehicle.state().binding.constraint == "red_light"
    assert drive(world, light.remaining_s + 5.0, lambda: world.vehicle.state().road == "West Gate")
    assert world.monitor.red_lights_run == 0


def test_a_misread_light_makes_it_wait_at_green_until_it_is_overridden() -> None:
    world = World(vehicles=0, faults=[MISREAD], start="Home", destination="Hospital")
    vehicle = world.vehicle
    vehicle.start()

    def waits_at_true_green() -> bool:
        light = world.true_light_ahead()
        return _waits_at_light(world) and light is not None and light.true_state == "green"

    assert drive(world, 120, waits_at_true_green)
    assert vehicle.state().traffic_light == "red"
    assert vehicle.override_traffic_light("green") is None
    assert vehicle.state().traffic_light == "green"
    assert drive(world, 10, lambda: vehicle.state().road == "West Gate")
    assert world.monitor.red_lights_run == world.monitor.red_lights_overridden == 0


def test_an_override_at_true_red_is_counted_apart() -> None:
    world = World(vehicles=0, faults=[MISREAD], start="Home", destination="Hospital")
    world.vehicle.start()

    def waits_at_true_red() -> bool:
        light = world.true_light_ahead()
        return _waits_at_light(world) and light is not None and light.true_state == "red" and light.remaining_s > 15

    assert drive(world, 120, waits_at_true_red)
    world.vehicle.override_traffic_light("green")
    assert drive(world, 10, lambda: world.vehicle.state().road == "West Gate")
    assert (world.monitor.red_lights_run, world.monitor.red_lights_overridden) == (0, 1)


def test_an_override_expires() -> None:
    world = World(vehicles=0, faults=[MISREAD], start="Home", destination="Hospital")
    world.vehicle.start()
    assert drive(world, 120, lambda: _waits_at_light(world))
    world.vehicle.stop()
    drive(world, 1)
    world.vehicle.override_traffic_light("green")
    drive(world, 29)
    assert world.vehicle.state().traffic_light == "green"
    drive(world, 2)
    assert world.vehicle.state().traffic_light == "red"


def test_an_override_counts_for_one_light_only() -> None:
    faults = [MISREAD, Fault("misread_light", "B2", "red")]
    world = World(vehicles=0, faults=faults, start="Home", destination="Hospital")
    vehicle = world.vehicle
    vehicle.start()
    assert drive(world, 120, lambda: _waits_at_light(world))
    vehicle.override_traffic_light("green")
    assert drive(world, 30, lambda: vehicle.state().road == "Main Street")
    assert drive(world, 30, lambda: _waits_at_light(world))
    assert vehicle.state().road == "Main Street"


def test_an_override_to_red_stops_at_green() -> None:
    for seed in range(20):
        world = World(vehicles=0, seed=seed, start=Placement("B1", "B2", 60), destination="Hospital")
        world.vehicle.start()
        drive(world, 2.0, lambda w=world: w.true_light_ahead() is not None)  # type: ignore[misc]
        light = world.true_light_ahead()
        if light is None and drive(world, 10, lambda w=world: w.true_light_ahead() is not None):  # type: ignore[misc]
            light = world.true_light_ahead()
        if light is not None and light.true_state == "green" and light.remaining_s > 5.0:
            break
    assert world.vehicle.override_traffic_light("red") is None
    assert drive(world, 25, lambda: _waits_at_light(world))


def test_without_a_light_there_is_nothing_to_override() -> None:
    world = World(vehicles=0, start="Home", destination="Hospital")
    assert code(world.vehicle.override_traffic_light("green")) == "no_traffic_light"


def test_the_passenger_cannot_send_the_car_into_crossing_traffic() -> None:
    """A car waits at a true red, is told "green", and another one comes with a true green from the side."""
    faults = [Fault("misread_light", "B2", "red")]
    world = World(vehicles=0, start=Placement("B1", "B2", 60), destination="Hospital", faults=faults)
    env, vehicle = world.environment, world.vehicle
    vehicle.start()
    crossing = env.scene.network.links["A2>B2"].lanes[0]

    def about_to_cross() -> bool:
        light = env.scene.signals
        return (
            _waits_at_light(world)
            and light.state(crossing.link, world.time_s) == "red"
            and light.remaining_s(crossing.link, world.time_s) < 2.0
        )

    assert drive(world, 150, about_to_cross)
    other = TrafficCar(env.road, env.scene, crossing, crossing.length - 40.0, 5.0, env.np_random, 1)
    other.path = [crossing, crossing.connectors["straight"]]
    env.road.vehicles.append(other)
    assert drive(world, 3, lambda: env.scene.signals.state(crossing.link, world.time_s) == "green")
    vehicle.override_traffic_light("green")
    line = next_line(vehicle)
    assert line is not None
    assert crossing_traffic_near(vehicle, line)
    assert not drive(world, 2.0, lambda: vehicle.connector_entered() is not None)
    assert vehicle.state().binding.constraint == "junction_occupied"
    assert drive(world, 25, lambda: vehicle.state().road == "Church Square")
    assert world.monitor.collisions == 0


@pytest.mark.parametrize("yellow_distance", [15.0, 60.0])
def test_at_yellow_it_stops_only_where_that_is_comfortable(yellow_distance: float) -> None:
    """The controller is shifted so that yellow begins at a chosen distance."""
    world = World(vehicles=0, start=Placement("B1", "B2", 60), destination="Hospital")
    vehicle = world.vehicle
    approach = world.environment.scene.network.links["B1>B2"]
    controllers = world.environment.scene.signals._controllers
    green = controllers["B2"]
    begin = green.timing.phase_s * green.junction.incoming.index(approach)
    vehicle.start()
    hold = type(green)(green.junction, green.timing, 0.0)

    def shift_to(into_phase: float) -> None:
        controllers["B2"] = type(hold)(hold.junction, hold.timing, begin + into_phase - world.time_s)  # type: ignore[index]

    def near() -> bool:
        shift_to(1.0)
        light = world.true_light_ahead()
        return light is not None and light.distance_m < yellow_distance and vehicle.speed > 8.0

    assert drive(world, 60, near)
    shift_to(green.timing.green_s)
    if yellow_distance < 30.0:
        assert drive(world, 4.0, lambda: vehicle.connector_entered() is not None)
    else:
        assert drive(world, 20.0, lambda: _waits_at_light(world))
    assert world.monitor.red_lights_run == 0


def test_a_car_between_the_stop_line_and_the_junction_keeps_others_out() -> None:
    """Once the override has sent the car over its line, a true green from the side has to wait for it."""
    faults = [Fault("misread_light", "B2", "green")]
    world = World(vehicles=0, start=Placement("B1", "B2", 150), destination="Hospital", faults=faults)
    env, vehicle = world.environment, world.vehicle
    crossing = env.scene.network.links["A2>B2"].lanes[0]
    other = TrafficCar(env.road, env.scene, crossing, crossing.length - 8.0, 0.0, env.np_random, 1)
    other.path = [crossing, crossing.connectors["straight"]]
    line = next_line(vehicle)
    assert line is not None
    vehicle.s = 0.5 + (vehicle.segment.stop_line or 0.0) - 5.0
    assert vehicle.connector_entered() is line.connector
    env.scene.occupancy.rebuild([vehicle, other])
    other_line = next_line(other)
    assert other_line is not None
    assert [demand.constraint for demand in junction_demands(other, other_line)] == ["junction_occupied"]
