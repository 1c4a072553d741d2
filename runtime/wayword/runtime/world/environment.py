"""The town as a highway-env environment."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium import spaces
from highway_env.envs.common.abstract import AbstractEnv
from highway_env.envs.common.action import ActionType
from highway_env.envs.common.observation import ObservationType

from wayword.runtime.world.ego import EgoCar
from wayword.runtime.world.layout import build_network
from wayword.runtime.world.maps import Map, MapError
from wayword.runtime.world.monitor import Monitor
from wayword.runtime.world.perception import Fault, Perception
from wayword.runtime.world.roadway import TownRoad
from wayword.runtime.world.scene import Scene
from wayword.runtime.world.signals import SignalController, Signals
from wayword.runtime.world.spawn import Placement, Spot, random_spots, spot_of
from wayword.runtime.world.traffic import TrafficCar

SIMULATION_HZ = 15
POLICY_HZ = 5


class _NoAction(ActionType):  # type: ignore[misc]  # highway-env has no types
    """The ego drives itself: there is nothing to choose."""

    def space(self) -> spaces.Space[Any]:
        return spaces.Discrete(1)

    def act(self, action: object) -> None:
        """Nothing."""


class _NoObservation(ObservationType):  # type: ignore[misc]  # highway-env has no types
    """The drivers read the scene themselves."""

    def space(self) -> spaces.Space[Any]:
        return spaces.Box(0.0, 1.0, (0,), np.float32)

    def observe(self) -> np.ndarray[Any, Any]:
        return np.zeros(0, np.float32)


class TownEnv(AbstractEnv):  # type: ignore[misc]  # highway-env has no types
    """A town with the ego and other cars in it.

    Attributes:
        scene: What the drivers need to know.
        ego: The passenger's car.
        monitor: Judges it.
    """

    scene: Scene
    ego: EgoCar
    monitor: Monitor

    def __init__(
        self,
        town: Map,
        seed: int,
        vehicles: int,
        faults: Sequence[Fault],
        start: Placement | str | None,
        render_mode: str | None = None,
    ) -> None:
        self._town = town
        self._seed = seed
        self._count = vehicles
        self._faults = tuple(faults)
        self._start = start
        super().__init__({"simulation_frequency": SIMULATION_HZ, "policy_frequency": POLICY_HZ}, render_mode)

    def define_spaces(self) -> None:
        """No observation and no action."""
        self.observation_type = _NoObservation(self)
        self.action_type = _NoAction(self)
        self.observation_space = self.observation_type.space()
        self.action_space = self.action_type.space()

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin anew, with the environment's own seed unless another one is given."""
        result: tuple[Any, dict[str, Any]] = super().reset(seed=self._seed if seed is None else seed, options=options)
        return result

    def _reset(self) -> None:
        rng = self.np_random
        network = build_network(self._town)
        timing = self._town.signals
        controllers = {
            junction.id: SignalController(
                junction, timing, float(rng.uniform(0.0, timing.phase_s * len(junction.incoming)))
            )
            for junction in network.junctions.values()
            if junction.signalised
        }
        self.scene = Scene(network, Signals(controllers), timing)
        self.road = TownRoad(self.scene, rng)
        spot = self._ego_spot(rng)
        perception = Perception(self.scene, self._faults)
        self.ego = EgoCar(self.road, self.scene, spot.lane, spot.s, perception)
        self.road.vehicles.append(self.ego)
        self.controlled_vehicles = [self.ego]
        for number, other in enumerate(random_spots(network, spot, self._count, rng)):
            self.road.vehicles.append(TrafficCar(self.road, self.scene, other.lane, other.s, other.speed, rng, number))
        self.scene.occupancy.rebuild(self.road.vehicles)
        self.monitor = Monitor(self.road, self.ego)

    def _ego_spot(self, rng: np.random.Generator) -> Spot:
        network, half = self.scene.network, self._town.junction_half_size_m
        start = self._start
        if isinstance(start, Placement):
            return spot_of(network, start, half)
        names = self._town.place_names
        name = start if start is not None else names[int(rng.integers(len(names)))]
        entry = next((place for place in self._town.places if place.name == name), None)
        if entry is None:
            raise MapError(f"there is no place {name!r} on the map {self._town.name}")
        return spot_of(network, Placement(entry.start, entry.end, entry.position_m), half)

    def _simulate(self, action: object = None) -> None:  # noqa: ARG002 - highway-env's signature
        """Step the simulation, the monitor watching every step."""
        for frame in range(SIMULATION_HZ // POLICY_HZ):
            self.road.act()
            self.road.step(1 / SIMULATION_HZ)
            self.monitor.observe()
            self.steps += 1
            if frame < SIMULATION_HZ // POLICY_HZ - 1:
                self._automatic_rendering()
        self.enable_auto_render = False

    def _reward(self, action: object) -> float:  # noqa: ARG002 - highway-env's signature
        return 0.0

    def _is_terminated(self) -> bool:
        return bool(self.ego.crashed)

    def _is_truncated(self) -> bool:
        return False
