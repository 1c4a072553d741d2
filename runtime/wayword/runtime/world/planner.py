"""The longitudinal planner: a list of constraints each of which allows some acceleration; the least one binds."""

import math
from typing import TYPE_CHECKING

from wayword.runtime.vehicle import Constraint, FactValue, OperationMode
from wayword.runtime.world import right_of_way
from wayword.runtime.world.demand import Demand, kmh
from wayword.runtime.world.lateral import LENGTH_M
from wayword.runtime.world.longitudinal import (
    HARD_BRAKING,
    approach_acceleration,
    cool_acceleration,
    desired_gap,
    follow_acceleration,
    free_acceleration,
    heuristic_acceleration,
    required_deceleration,
    stop_acceleration,
)
from wayword.runtime.world.network import LaneSegment
from wayword.runtime.world.occupancy import Neighbour

if TYPE_CHECKING:
    from wayword.runtime.world.car import Car

LOOKOUT_M = 100.0
"""How far ahead leaders are looked for."""
PARKED_GAP_M = 20.0
"""Gap kept to a parked car, so that there is room to pull out and pass it."""
_CURVE_SHARE = 0.95
"""Share of the curve speed that is driven; tracking takes the rest."""
_CURVE_PREVIEW_M = 3.0
_CREEP = 0.15
"""A standing car doesn't move for less than this acceleration, in m/s²."""


def curve_speed(connector: LaneSegment, max_lat_accel: float) -> float:
    """Speed at which a curve gives a lateral acceleration v²κ a little below the maximum, in m/s."""
    curvature = abs(connector.curve.curvature)
    return _CURVE_SHARE * math.sqrt(max_lat_accel / curvature) if curvature > 0.0 else math.inf


class Planner:
    """Plans the acceleration of one car.

    Attributes:
        leader: The car ahead at the latest decision.
        light: The rule about traffic lights, with its memory of a yellow.
        stop_rule: The rule about the passenger's STOP, with its memory of having begun to brake.
    """

    def __init__(self) -> None:
        self.leader: Neighbour | None = None
        self.light = right_of_way.LightRule()
        self.stop_rule = right_of_way.StopRule()

    def plan(self, car: "Car") -> Demand:
        """The least of what the constraints allow."""
        self.leader = find_leader(car)
        if car.mode is OperationMode.PARKED:
            return Demand(0.0 if car.speed == 0.0 else -car.parameters.max_decel, "parked", {})
        if car.mode is OperationMode.EMERGENCY:
            return Demand(-HARD_BRAKING, "emergency", {}, urgent=True)
        cruise = _cruise(car)
        demands = [cruise, *_preview(car)]
        demands += _following(car, self.leader, cruise.acceleration)
        line = right_of_way.next_line(car)
        if line is not None:
            demands += self.light.demands(car, line)
            demands += right_of_way.junction_demands(car, line)
        demands += _destination(car)
        if car.mode is OperationMode.STOPPING:
            demands += self.stop_rule.demands(car, line)
        least = min(demands, key=lambda demand: demand.acceleration)
        if car.speed == 0.0 and 0.0 < least.acceleration < _CREEP:
            return least._replace(acceleration=0.0)
        return least


def find_leader(car: "Car") -> Neighbour | None:
    """The nearest car ahead in the path; during a lane change also in the lane that is being left."""
    occupancy = car.scene.occupancy
    leader = occupancy.leader(car, car.path, car.s, LOOKOUT_M)
    shift = car.shift
    if shift is not None and not shift.clear_of_origin and car.segment.kind == "road":
        other = occupancy.leader(car, [shift.origin], car.s, LOOKOUT_M)
        if other is not None and (leader is None or other.gap < leader.gap):
            return other
    return leader


def legal_limit(car: "Car") -> float:
    """Least limit of the segments that the car is on, in m/s."""
    limit = car.segment.limit_mps
    if car.front > car.segment.length and len(car.path) > 1:
        return min(limit, car.path[1].limit_mps)
    return limit


def _cruise(car: "Car") -> Demand:
    """Towards the legal limit or the passenger's maximum."""
    p, limit = car.parameters, legal_limit(car)
    wanted = min(limit, p.max_vel)
    acceleration = free_acceleration(car.speed, wanted, p.max_accel, p.max_decel)
    if car.speed < 0.93 * wanted:
        return Demand(acceleration, "free_road", {"wanted_kmh": kmh(wanted)})
    name: Constraint = "max_vel" if p.max_vel < limit else "speed_limit"
    return Demand(acceleration, name, {"limit_kmh": kmh(limit), "max_vel_kmh": kmh(p.max_vel)})


def _preview(car: "Car") -> list[Demand]:
    """Lower limits and curves ahead."""
    p, speed, demands = car.parameters, car.anticipated_speed, []
    start = -car.s
    for segment in car.path:
        if segment.kind == "connector" and segment.curve.curvature != 0.0:
            target = curve_speed(segment, p.max_lat_accel)
            distance = start - _CURVE_PREVIEW_M
            acceleration = approach_acceleration(speed, target, distance, p.max_decel)
            facts: dict[str, FactValue] = {
                "curve_kmh": kmh(target),
                "junction": segment.junction.name,
                "direction": segment.movement,
            }
            demands.append(Demand(acceleration, "curve", facts))
        elif start > LENGTH_M and segment.limit_mps < car.segment.limit_mps:
            acceleration = approach_acceleration(speed, segment.limit_mps, start - LENGTH_M, p.max_decel)
            demands.append(Demand(acceleration, "speed_limit", {"limit_kmh": kmh(segment.limit_mps)}))
        start += segment.length
    return demands


def _following(car: "Car", leader: Neighbour | None, free: float) -> list[Demand]:
    if leader is None:
        return []
    p, other = car.parameters, leader.car
    facts: dict[str, FactValue] = {"leader_kmh": kmh(other.speed), "gap_m": round(leader.gap, 1)}
    if leader.gap <= 0.1:
        return [Demand(-HARD_BRAKING, "leader", facts, urgent=True)]
    wanted = desired_gap(car.speed, other.speed, p.min_gap, p.time_gap, p.max_accel, p.max_decel)
    following = follow_acceleration(free, wanted / leader.gap, p.max_accel)
    heuristic = heuristic_acceleration(car.speed, other.speed, other.acceleration, leader.gap, p.max_accel)
    acceleration = max(-HARD_BRAKING, cool_acceleration(following, heuristic, p.max_decel))
    if _to_be_passed(car, other):
        acceleration = min(acceleration, _keep_back(car, leader.gap - PARKED_GAP_M))
    return [Demand(acceleration, "leader", facts, urgent=acceleration < -p.max_decel)]


def _keep_back(car: "Car", distance: float) -> float:
    """Stop further back from a parked car, where that is comfortably possible."""
    decel = car.parameters.max_decel
    if required_deceleration(car.speed, 0.0, distance) > decel:
        return math.inf
    return stop_acceleration(car.speed, distance, decel)


def _to_be_passed(car: "Car", other: "Car") -> bool:
    return other.mode is OperationMode.PARKED and other.segment is car.segment and car.mode is not other.mode


def _destination(car: "Car") -> list[Demand]:
    """Stop at the place where the trip ends."""
    distance = car.distance_to_goal()
    if distance is None:
        return []
    acceleration = stop_acceleration(car.speed, distance, car.parameters.max_decel)
    return [Demand(acceleration, "destination", {"distance_m": round(max(0.0, distance), 1)})]
