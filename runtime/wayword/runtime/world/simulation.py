"""The world that the executor drives in."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from wayword.runtime.vehicle import LightState, Refusal
from wayword.runtime.world.ego import EgoCar
from wayword.runtime.world.environment import TownEnv
from wayword.runtime.world.maps import Map, MapError, load_map
from wayword.runtime.world.monitor import Monitor
from wayword.runtime.world.perception import Fault
from wayword.runtime.world.report import light_ahead
from wayword.runtime.world.right_of_way import LINE_MARGIN_M
from wayword.runtime.world.spawn import Placement

POLICY_STEP_S = 0.2
"""Simulated time of one step of the world."""


@dataclass(frozen=True, slots=True)
class LightAhead:
    """The next traffic light, as it is and as the ego sees it.

    Attributes:
        junction: Identifier of the junction.
        junction_name: Its name.
        distance_m: From the front bumper to the stop line.
        perceived_state: What the ego sees.
        true_state: What it shows.
        remaining_s: How long it still shows that.
    """

    junction: str
    junction_name: str
    distance_m: float
    perceived_state: LightState
    true_state: LightState
    remaining_s: float


class OtherCar(NamedTuple):
    """Another car, for recordings and drawings.

    Attributes:
        x_m: Centre, east.
        y_m: Centre, south.
        heading_rad: Growing clockwise.
        speed_mps: Its speed.
    """

    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float


class World:
    """A simulated town with the passenger's car in it.

    Attributes:
        map: The map.
    """

    def __init__(
        self,
        map_: Map | None = None,
        *,
        seed: int = 0,
        vehicles: int = 20,
        faults: Sequence[Fault] = (),
        start: Placement | str | None = None,
        destination: str | None = None,
        render_mode: str | None = None,
    ) -> None:
        """Set up a town.

        Args:
            map_: The map; the built-in town without one.
            seed: Everything random follows from it.
            vehicles: How many other cars there are.
            faults: Faults of the ego's perception.
            start: Where the ego stands, parked, at the beginning; a random place without one.
            destination: The goal of its trip.
            render_mode: As in highway-env: ``rgb_array``, ``human`` or None.

        Raises:
            MapError: If start, destination or a fault's junction isn't on the map.
        """
        self.map = map_ if map_ is not None else load_map()
        junctions = {junction.id for junction in self.map.junctions}
        for fault in faults:
            if fault.junction not in junctions:
                raise MapError(f"there is no junction {fault.junction!r} on the map {self.map.name}")
        self._env = TownEnv(self.map, seed, vehicles, faults, start, render_mode)
        if destination is not None and isinstance(self.vehicle.set_destination(destination), Refusal):
            raise MapError(f"there is no place {destination!r} on the map {self.map.name}")

    def step(self) -> None:
        """Let 0.2 s pass."""
        self._env.step(None)

    @property
    def environment(self) -> TownEnv:
        """The highway-env environment behind this world, for rendering it."""
        return self._env

    @property
    def time_s(self) -> float:
        """Simulated time since the start."""
        return self._env.scene.time_s

    @property
    def vehicle(self) -> EgoCar:
        """The passenger's car."""
        return self._env.ego

    @property
    def monitor(self) -> Monitor:
        """Judges the car by the true world."""
        return self._env.monitor

    def true_light_ahead(self) -> LightAhead | None:
        """The next light within sight, None without one."""
        line = light_ahead(self.vehicle)
        if line is None:
            return None
        scene, approach = self._env.scene, line.approach
        return LightAhead(
            junction=approach.end.id,
            junction_name=approach.end.name,
            distance_m=line.distance + LINE_MARGIN_M,
            perceived_state=self.vehicle.sees(approach),
            true_state=scene.signals.state(approach, scene.time_s),
            remaining_s=scene.signals.remaining_s(approach, scene.time_s),
        )

    def others(self) -> tuple[OtherCar, ...]:
        """The other cars."""
        return tuple(
            OtherCar(float(car.position[0]), float(car.position[1]), float(car.heading), float(car.speed))
            for car in self._env.road.vehicles
            if car is not self.vehicle
        )
