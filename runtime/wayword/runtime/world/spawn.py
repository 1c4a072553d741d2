"""Where cars are at the beginning."""

import math
from dataclasses import dataclass

import numpy as np

from wayword.runtime.world.lateral import LENGTH_M
from wayword.runtime.world.maps import MapError
from wayword.runtime.world.network import LaneSegment, Network

SPACING_M = 25.0
"""Least distance between two cars' rear axles at the beginning."""
CLEAR_OF_EGO_M = 45.0
_EDGE_M = 6.0
_INITIAL_SHARE = 0.6
_GENTLE_DECEL = 1.0
_ATTEMPTS = 200


@dataclass(frozen=True, slots=True)
class Placement:
    """Where the ego begins.

    Attributes:
        start: Junction that its direction of travel comes from.
        end: Junction that it leads to.
        position_m: Distance of its centre from the middle of `start`.
        lane: From 1 at the left; None for the one at the kerb.
    """

    start: str
    end: str
    position_m: float
    lane: int | None = None


@dataclass(frozen=True, slots=True)
class Spot:
    """A lane and where the rear axle is along it, with an initial speed in m/s."""

    lane: LaneSegment
    s: float
    speed: float = 0.0


def spot_of(network: Network, placement: Placement, half_size_m: float) -> Spot:
    """The spot of a placement.

    Raises:
        MapError: If there is no such road, lane or position.
    """
    link = network.links.get(f"{placement.start}>{placement.end}")
    if link is None:
        raise MapError(f"there is no road from {placement.start} to {placement.end}")
    number = placement.lane if placement.lane is not None else len(link.lanes)
    if not 1 <= number <= len(link.lanes):
        raise MapError(f"the road from {placement.start} to {placement.end} has no lane {number}")
    s = placement.position_m - half_size_m - LENGTH_M / 2
    if not 0.0 <= s <= link.length - LENGTH_M - 2.0:
        raise MapError(f"position {placement.position_m:g} m isn't between the road's junctions")
    return Spot(link.lanes[number - 1], s)


def random_spots(network: Network, taken: Spot, count: int, rng: np.random.Generator) -> list[Spot]:
    """Spots for other cars, apart from each other and from the ego's."""
    lanes = [lane for link in network.links.values() for lane in link.lanes]
    spots: list[Spot] = []
    for _ in range(_ATTEMPTS * count):
        if len(spots) == count:
            break
        lane = lanes[int(rng.integers(len(lanes)))]
        s = float(rng.uniform(_EDGE_M, lane.length - LENGTH_M - _EDGE_M))
        if _is_free(lane, s, taken, CLEAR_OF_EGO_M) and all(
            spot.lane is not lane or abs(spot.s - s) >= SPACING_M for spot in spots
        ):
            spots.append(Spot(lane, s, _initial_speed(lane, s)))
    return spots


def _is_free(lane: LaneSegment, s: float, taken: Spot, clearance: float) -> bool:
    return math.dist(lane.curve.point(s), taken.lane.curve.point(taken.s)) >= clearance


def _initial_speed(lane: LaneSegment, s: float) -> float:
    """A speed from which the car can stop gently at the end of the lane."""
    room = max(0.0, lane.length - s - LENGTH_M - 4.0)
    return min(_INITIAL_SHARE * lane.limit_mps, math.sqrt(2 * _GENTLE_DECEL * room))
