"""Who may enter a junction: traffic lights, room behind it, and cars that are still inside."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from wayword.runtime.vehicle import Constraint, FactValue
from wayword.runtime.world.demand import Demand, kmh
from wayword.runtime.world.lateral import LENGTH_M
from wayword.runtime.world.longitudinal import required_deceleration, stop_acceleration, stopping_distance
from wayword.runtime.world.network import LaneSegment, Link

if TYPE_CHECKING:
    from wayword.runtime.world.car import Car

LINE_MARGIN_M = 0.7
"""The front bumper comes to rest this far before the stop line."""
HARDEST_STOP = 6.0
"""A stop at a line that would need more braking than this isn't tried any more, in m/s²."""
SLOW_MPS = 3.0
ROOM_M = 8.0
"""What a standing car takes up of a lane, its gap included."""
_YELLOW_RESERVE_S = 0.5
_SLOWING_SHARE = 0.8
"""A car that slows for a turn covers this share of what its present speed promises."""
_CLEARANCE_S = 1.0
_CROSSING_M = 30.0


class StopLine(NamedTuple):
    """The next stop line on the path.

    Attributes:
        approach: The link that it ends.
        distance: From the front bumper to where it should stop, in m.
        connector: The way across the junction.
    """

    approach: Link
    distance: float
    connector: LaneSegment


def next_line(car: "Car") -> StopLine | None:
    """The next stop line that the front bumper hasn't passed yet."""
    start = -car.front
    for lane, connector in zip(car.path, car.path[1:], strict=False):
        if lane.stop_line is not None and start + lane.stop_line > 0.0:
            return StopLine(lane.link, start + lane.stop_line - LINE_MARGIN_M, connector)
        start += lane.length
    return None


def _stop_at(car: "Car", line: StopLine, name: Constraint, reason: str | None = None) -> Demand:
    acceleration = stop_acceleration(car.speed, line.distance, car.parameters.max_decel)
    facts: dict[str, FactValue] = {
        "junction": line.approach.end.name,
        "distance_m": round(max(0.0, line.distance), 1),
    }
    if reason is not None:
        facts["reason"] = reason
    return Demand(acceleration, name, facts, urgent=acceleration < -car.parameters.max_decel)


@dataclass(slots=True)
class LightRule:
    """Stop at red; stop at yellow where that is comfortable or the line can't be reached in time.

    Attributes:
        yellow_at: The approach that showed yellow at the latest decision.
        since_s: When that began.
        stops: Whether the car has decided to stop at it.
    """

    yellow_at: Link | None = None
    since_s: float = 0.0
    stops: bool = False

    def demands(self, car: "Car", line: StopLine) -> list[Demand]:
        """What the next light asks for."""
        state = car.sees(line.approach)
        needed = _needed(car, line)
        if state != "yellow":
            self.yellow_at = None
            if state == "green" or needed > HARDEST_STOP:
                return []
            return [_stop_at(car, line, "red_light")]
        if self.yellow_at is not line.approach:
            self.yellow_at, self.since_s, self.stops = line.approach, car.scene.time_s, False
        self.stops = needed <= HARDEST_STOP and (self.stops or self._must_stop(car, line, needed))
        return [_stop_at(car, line, "yellow_light")] if self.stops else []

    def _must_stop(self, car: "Car", line: StopLine, needed: float) -> bool:
        """The dilemma zone (Gazis, Herman and Maradudin, 1960), with the time that is left of the yellow."""
        elapsed = car.scene.time_s - self.since_s
        left = max(0.0, car.scene.timing.yellow_s - elapsed - _YELLOW_RESERVE_S)
        reach = _SLOWING_SHARE * car.speed * left
        return needed <= car.parameters.max_decel or line.distance + LINE_MARGIN_M > reach


def _needed(car: "Car", line: StopLine) -> float:
    """Braking needed for the line. A car that stands in front of it needs none, if only by centimetres."""
    return required_deceleration(car.speed, 0.0, line.distance + 0.5 * LINE_MARGIN_M)


def junction_demands(car: "Car", line: StopLine) -> list[Demand]:
    """Stay out while a car crosses the way, and while there is no room behind the junction."""
    needed = _needed(car, line)
    if needed > HARDEST_STOP or line.distance > 80.0:
        return []
    demands = []
    if _crossed(car, line):
        demands.append(_stop_at(car, line, "junction_occupied", "inside"))
    elif car.relies_on_passenger(line.approach) and crossing_traffic_near(car, line):
        demands.append(_stop_at(car, line, "junction_occupied", "crossing_traffic"))
    if needed <= car.parameters.max_decel + 1.0 and not _room_behind(car, line.connector):
        demands.append(_stop_at(car, line, "exit_blocked"))
    return demands


def _crossed(car: "Car", line: StopLine) -> bool:
    """Whether a car is on a conflicting connector and will still be there when we arrive."""
    arrival = max(0.0, line.distance) / max(car.speed, 1.0)
    for connector in line.connector.conflicts:
        for other in car.scene.occupancy.crossing(connector):
            left = connector.length + (LENGTH_M if other.segment is not connector else -other.s)
            if left / max(other.speed, 0.5) + _CLEARANCE_S > arrival:
                return True
    return False


def _room_behind(car: "Car", connector: LaneSegment) -> bool:
    """Whether the exit lane has room for us and for those who are on their way there already."""
    occupancy, exit_lane = car.scene.occupancy, connector.exit
    if exit_lane is None:
        return True
    last = min((other for other in occupancy.on(exit_lane)), key=lambda other: other.s, default=None)
    if last is None or last.speed > SLOW_MPS:
        return True
    ahead = sum(len(occupancy.on(feeder)) for feeder in exit_lane.feeders)
    return last.s > ROOM_M * (ahead + 1)


def crossing_traffic_near(car: "Car", line: StopLine) -> bool:
    """Whether a conflicting approach truly has right of way and a car near its stop line."""
    scene = car.scene
    for connector in line.connector.conflicts:
        if scene.signals.state(connector.link, scene.time_s) == "red":
            continue
        lane = connector.link.lanes[connector.lane]
        for other in scene.occupancy.on(lane):
            reach = max(_CROSSING_M, 5.0 * other.speed)
            if other is not car and lane.length - other.front < reach:
                return True
    return False


@dataclass(slots=True)
class StopRule:
    """The passenger's STOP: brake comfortably in the lane, but neither inside a junction nor between two lanes.

    Attributes:
        braking: Whether it has begun, after which it isn't put off any more.
    """

    braking: bool = False

    def demands(self, car: "Car", line: StopLine | None) -> list[Demand]:
        """Brake, unless there is a junction to be passed or a lane change to be finished first."""
        if not self.braking:
            distance = stopping_distance(car.speed, car.parameters.max_decel)
            busy = car.connector_entered() is not None or car.shift is not None
            self.braking = not busy and (line is None or distance <= line.distance)
        if not self.braking:
            return []
        facts = {"speed_kmh": kmh(car.speed)}
        return [Demand(-car.parameters.max_decel, "stopping", facts)]
