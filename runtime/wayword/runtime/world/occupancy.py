"""Who is on which lane: an index rebuilt every time step, and the searches for cars ahead, behind and across."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from wayword.runtime.world.lateral import LENGTH_M
from wayword.runtime.world.network import LaneSegment

if TYPE_CHECKING:
    from wayword.runtime.world.car import Car


class Neighbour(NamedTuple):
    """A car ahead or behind, and the bumper-to-bumper gap to it in m."""

    car: "Car"
    gap: float


class Occupancy:
    """Cars by the segment that their rear axle is on. A car that changes lanes occupies both.

    A car reaches ahead of its rear axle by its length, so the gap to a leader is the difference of the rear axles'
    positions less one length, also across segments.
    """

    def __init__(self) -> None:
        self._cars: dict[LaneSegment, list[Car]] = {}
        self._crossing: dict[LaneSegment, list[Car]] = {}

    def rebuild(self, cars: Iterable["Car"]) -> None:
        """Index the cars anew."""
        self._cars, self._crossing = {}, {}
        for car in cars:
            self._cars.setdefault(car.segment, []).append(car)
            if car.shift is not None and not car.shift.clear_of_origin:
                self._cars.setdefault(car.shift.origin, []).append(car)
            connector = car.connector_entered()
            if connector is not None:
                self._crossing.setdefault(connector, []).append(car)

    def on(self, segment: LaneSegment) -> Sequence["Car"]:
        """Cars with their rear axle on a segment."""
        return self._cars.get(segment, ())

    def crossing(self, connector: LaneSegment) -> Sequence["Car"]:
        """Cars any part of which is on a connector."""
        return self._crossing.get(connector, ())

    def leader(self, car: "Car", path: Sequence[LaneSegment], s: float, reach: float) -> Neighbour | None:
        """The next car ahead along a path whose first segment `car` is on at `s`, within `reach` metres."""
        start = -s
        for segment in path:
            nearest = self._first_ahead(car, segment, s if segment is path[0] else -1.0)
            if nearest is not None:
                leader, position = nearest
                return Neighbour(leader, start + position - LENGTH_M)
            start += segment.length
            if start - LENGTH_M > reach:
                break
        return None

    def _first_ahead(self, car: "Car", segment: LaneSegment, after: float) -> tuple["Car", float] | None:
        """The next car on a segment, on one that parts from it, or on one that joins it at its end."""
        best: Car | None = None
        least = float("inf")
        for other in self._cars.get(segment, ()):
            if other is not car and after < other.s < least:
                best, least = other, other.s
        for sibling, shared in segment.siblings:
            for other in self._cars.get(sibling, ()):
                if other is not car and after < other.s < min(shared, least):
                    best, least = other, other.s
        for feeder in segment.exit.feeders if segment.exit is not None else ():
            for other in self._cars.get(feeder, ()) if feeder is not segment else ():
                position = segment.length - feeder.length + other.s  # as far from the common exit
                if other is not car and after < position < least:
                    best, least = other, position
        return None if best is None else (best, least)

    def follower(self, car: "Car", lane: LaneSegment, s: float, reach: float) -> Neighbour | None:
        """The next car behind position `s` of a lane, looking back over what feeds it."""
        best: Neighbour | None = None
        for other in self._cars.get(lane, ()):
            if other is not car and other.s <= s:
                gap = s - other.s - LENGTH_M
                if best is None or gap < best.gap:
                    best = Neighbour(other, gap)
        if best is not None or s > reach:
            return best
        for feeder in lane.feeders:
            behind = self.follower(car, feeder, s + feeder.length, reach)
            if behind is not None and (best is None or behind.gap < best.gap):
                best = behind
        return best
