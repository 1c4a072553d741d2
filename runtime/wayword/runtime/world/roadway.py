"""highway-env's road and network, filled from our lane graph, with cheap stepping and collision checks."""

import math
from typing import Any

import numpy as np
from highway_env.road.lane import AbstractLane, CircularLane, LineType, StraightLane
from highway_env.road.road import Road, RoadNetwork

from wayword.runtime.world.car import Car
from wayword.runtime.world.geometry import Arc
from wayword.runtime.world.maps import LANE_WIDTH_M
from wayword.runtime.world.network import LaneSegment, Network
from wayword.runtime.world.scene import Scene

_REACH_M = 6.0
"""Two cars whose centres are further apart than this can't touch: their diagonals are 5.4 m."""


def highway_network(network: Network) -> RoadNetwork:
    """Our lane graph as highway-env knows it, for its vehicles and its rendering."""
    roads = RoadNetwork()
    for segment in network.segments():
        start, end, _ = segment.index
        roads.add_lane(start, end, _highway_lane(segment))
    return roads


def _highway_lane(segment: LaneSegment) -> AbstractLane:
    curve = segment.curve
    options: dict[str, Any] = {"width": LANE_WIDTH_M, "speed_limit": segment.limit_mps}
    if segment.kind == "connector":
        options["line_types"] = (LineType.NONE, LineType.NONE)
    else:
        left = LineType.STRIPED if segment.left is not None else LineType.CONTINUOUS_LINE
        right = LineType.NONE if segment.right is not None else LineType.CONTINUOUS_LINE
        options["line_types"] = (left, right)
    if isinstance(curve, Arc):
        phase = math.atan2(curve.y - curve.centre[1], curve.x - curve.centre[0])
        end = phase + curve.length * curve.curvature
        radius, clockwise = 1 / abs(curve.curvature), curve.curvature > 0
        return CircularLane(curve.centre, radius, phase, end, clockwise, **options)
    return StraightLane(curve.point(0.0), curve.point(curve.length), **options)


class TownRoad(Road):  # type: ignore[misc]  # highway-env has no types
    """A road whose cars know where they are, so that nobody has to search for them.

    Attributes:
        scene: What the drivers need to know.
        collisions: Pairs of cars that have hit each other, the one that is earlier in ``vehicles`` first.
    """

    def __init__(self, scene: Scene, np_random: np.random.Generator) -> None:
        super().__init__(network=highway_network(scene.network), np_random=np_random)
        self.scene = scene
        self.collisions: list[tuple[Car, Car]] = []
        self._steps = 0

    def act(self) -> None:
        """Let every driver decide, all on the same state of the world."""
        self.scene.occupancy.rebuild(self.vehicles)
        for car in self.vehicles:
            car.act()

    def step(self, dt: float) -> None:
        """Move every car, then look for collisions among those that are near each other."""
        self._steps += 1
        self.scene.time_s = self._steps * dt
        for car in self.vehicles:
            car.step(dt)
        positions = [(float(car.position[0]), float(car.position[1])) for car in self.vehicles]
        for i, (x, y) in enumerate(positions):
            for j in range(i + 1, len(positions)):
                if abs(positions[j][0] - x) < _REACH_M and abs(positions[j][1] - y) < _REACH_M:
                    self._collide(self.vehicles[i], self.vehicles[j], dt)

    def _collide(self, one: Car, other: Car, dt: float) -> None:
        if (one, other) in self.collisions:
            return
        one.handle_collisions(other, dt)
        if one.crashed and other.crashed:
            self.collisions.append((one, other))
