"""The other cars: drivers who turn at random as their lane allows."""

from typing import TYPE_CHECKING

import numpy as np

from wayword.runtime.vehicle import OperationMode, Side
from wayword.runtime.world.car import Car
from wayword.runtime.world.lane_change import LaneChange, length_needed, room_ahead
from wayword.runtime.world.network import LaneSegment
from wayword.runtime.world.parameters import random_driver
from wayword.runtime.world.scene import Scene

if TYPE_CHECKING:
    from wayword.runtime.world.roadway import TownRoad

PLAN_EVERY = 3
"""Other drivers decide in every third time step, at 5 Hz, and not all in the same one."""
_BLOCKED_PATIENCE_S = 8.0
_NOTICE_PARKED_M = 80.0


class RandomNavigator:
    """Chooses a way on at random and keeps to it until the junction has been passed."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self._chosen: dict[LaneSegment, LaneSegment] = {}

    def onward(self, car: Car, lane: LaneSegment) -> LaneSegment | None:  # noqa: ARG002 - Navigator
        """The connector chosen for a lane."""
        if lane not in self._chosen:
            ways = list(lane.connectors.values())
            self._chosen[lane] = ways[int(self._rng.integers(len(ways)))]
        return self._chosen[lane]

    def choose_again(self, car: Car, lane: LaneSegment) -> None:
        """Take another way than the one that is blocked."""
        blocked = self._chosen.pop(lane)
        ways = [way for way in lane.connectors.values() if way is not blocked]
        self._chosen[lane] = ways[int(self._rng.integers(len(ways)))] if ways else blocked
        car.replan()

    def entered(self, car: Car, segment: LaneSegment) -> None:
        """Forget the choice for a junction once it has been passed."""
        if segment.kind == "road":
            self._chosen = {lane: way for lane, way in self._chosen.items() if lane in car.path}


class TrafficCar(Car):
    """Another driver's car."""

    def __init__(
        self,
        road: "TownRoad",
        scene: Scene,
        lane: LaneSegment,
        s: float,
        speed: float,
        rng: np.random.Generator,
        number: int,
    ) -> None:
        """Place a car whose driver's manners come from `rng`."""
        self.random_navigator = RandomNavigator(rng)
        self._countdown = number % PLAN_EVERY
        self._blocked_since_s: float | None = None
        super().__init__(road, scene, lane, s, speed, random_driver(rng), self.random_navigator)

    def _plans_now(self) -> bool:
        self._countdown = (self._countdown + 1) % PLAN_EVERY
        if self._countdown:
            return False
        if self.lane_change is None and self.shift is None:
            self._pass_parked()
        self._leave_blocked_way()
        return True

    def _pass_parked(self) -> None:
        """Move over where a parked car (its hazard lights are on) blocks the lane."""
        leader = self.planner.leader
        if leader is None or leader.car.mode is not OperationMode.PARKED or self.segment.kind != "road":
            return
        if leader.gap < _NOTICE_PARKED_M and leader.car.segment is self.segment:
            side: Side = "left" if self.segment.left is not None else "right"
            if self.segment.neighbour(side) is not None and room_ahead(self) > length_needed(self, 0.0):
                self.lane_change = LaneChange(self, side, "pass")

    def _leave_blocked_way(self) -> None:
        """Choose another way where the exit has been blocked for long."""
        if self.demand.constraint != "exit_blocked" or self.segment.kind != "road":
            self._blocked_since_s = None
        elif self._blocked_since_s is None:
            self._blocked_since_s = self.scene.time_s
        elif self.scene.time_s - self._blocked_since_s > _BLOCKED_PATIENCE_S:
            self._blocked_since_s = None
            self.random_navigator.choose_again(self, self.segment)
