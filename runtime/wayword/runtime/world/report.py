"""What the ego tells about itself: the state of the vehicle interface and the status for translations."""

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, NamedTuple

from wayword.compiler.status import VehicleStatus
from wayword.compiler.units import UNITS
from wayword.compiler.vocabulary import DRIVING_PARAMETERS, Measure
from wayword.runtime.vehicle import Binding, OperationMode, SeenVehicle, VehicleState
from wayword.runtime.world.geometry import wrap_angle
from wayword.runtime.world.lateral import AXLE_M
from wayword.runtime.world.network import Link
from wayword.runtime.world.planner import legal_limit
from wayword.runtime.world.right_of_way import LINE_MARGIN_M, StopLine, next_line
from wayword.runtime.world.router import TURN_PENALTY_S, expected_wait_s

if TYPE_CHECKING:
    from wayword.runtime.world.car import Car
    from wayword.runtime.world.ego import EgoCar

LIGHT_SIGHT_M = 80.0
"""How far a traffic light is seen."""
SURROUNDINGS_M = 50.0
"""How far other cars are told of."""


class Progress(NamedTuple):
    """How far the trip still is.

    Attributes:
        distance_m: Length of the remaining route.
        eta_s: Estimated time for it.
    """

    distance_m: float
    eta_s: float


class NextManoeuvre(NamedTuple):
    """What the route does next."""

    kind: Literal["left", "right", "straight", "arrive"]
    place: str
    distance_m: float


def light_ahead(ego: "EgoCar") -> StopLine | None:
    """The next stop line within sight."""
    line = next_line(ego)
    return line if line is not None and line.distance + LINE_MARGIN_M <= LIGHT_SIGHT_M else None


def vehicle_state(ego: "EgoCar") -> VehicleState:
    """The present state of the ego."""
    on_road = ego.segment.kind == "road"
    line, leader = light_ahead(ego), ego.planner.leader
    progress, manoeuvre = trip_progress(ego), next_manoeuvre(ego)
    return VehicleState(
        time_s=ego.scene.time_s,
        x_m=float(ego.position[0]),
        y_m=float(ego.position[1]),
        heading_rad=wrap_angle(float(ego.heading)),
        speed_mps=float(ego.speed),
        acceleration_mps2=ego.acceleration,
        lateral_acceleration_mps2=float(ego.speed) ** 2 * ego.curvature,
        mode=ego.mode,
        road=ego.segment.link.street if on_road else ego.segment.junction.name,
        lane=_lane_driven_on(ego) + 1 if on_road else None,
        lanes=len(ego.segment.link.lanes) if on_road else None,
        speed_limit_mps=legal_limit(ego),
        lead_gap_m=leader.gap if leader is not None else None,
        lead_speed_mps=float(leader.car.speed) if leader is not None else None,
        traffic_light=ego.sees(line.approach) if line is not None else None,
        traffic_light_distance_m=line.distance + LINE_MARGIN_M if line is not None else None,
        destination=ego.trip.goal.name if ego.trip.goal is not None else None,
        waypoints=(),
        remaining_distance_m=progress.distance_m if progress is not None else None,
        eta_s=progress.eta_s if progress is not None else None,
        next_manoeuvre=manoeuvre.kind if manoeuvre is not None else None,
        next_manoeuvre_place=manoeuvre.place if manoeuvre is not None else None,
        next_manoeuvre_distance_m=manoeuvre.distance_m if manoeuvre is not None else None,
        indicator=ego.indicator,
        binding=Binding(ego.demand.constraint, ego.demand.facts),
        surroundings=surroundings(ego),
    )


def _lane_driven_on(ego: "EgoCar") -> int:
    """The lane that the car is mostly on, from 0; during a lane change the old one for the first half."""
    shift = ego.shift
    return shift.origin.lane if shift is not None and shift.progress < 0.5 else ego.segment.lane


def _route_from_here(ego: "EgoCar") -> tuple[float, list[Link]]:
    """Distance from the car's centre to the end of the present link or connector, and the links from there on."""
    rest = ego.segment.length - ego.s - AXLE_M
    link = ego.segment.link
    if ego.segment.exit is not None:
        return rest, ego.trip.route(ego.segment.exit.link)
    return rest, ego.trip.route(link)[1:]


def trip_progress(ego: "EgoCar") -> Progress | None:
    """Length and time of the remaining route: at the limits, with the mean wait at each light and turn."""
    goal = ego.trip.goal
    if goal is None:
        return None
    near = ego.distance_to_goal()
    if near is not None and ego.segment.link is goal.link and ego.segment.kind == "road":
        return Progress(max(0.0, near), max(0.0, near) / _pace(ego, goal.link))
    distance, links = _route_from_here(ego)
    time = distance / _pace(ego, ego.segment.link)
    previous = ego.segment.link
    if ego.segment.exit is None and links:
        time += _wait(ego, previous)
    else:
        previous = links[0]
    for link in links:
        if link is not previous:
            crossing = min(
                (way.length for lane in previous.lanes for way in lane.connectors.values() if way.exit in link.lanes),
                default=0.0,
            )
            distance += crossing
            time += crossing / _pace(ego, previous) + _turning(previous, link)
        length = goal.s if link is goal.link and link is links[-1] else link.length
        distance += length
        time += length / _pace(ego, link) + (0.0 if link is links[-1] else _wait(ego, link))
        previous = link
    return Progress(distance, time)


def _pace(ego: "EgoCar", link: Link) -> float:
    return max(1.0, min(link.limit_mps, ego.parameters.max_vel))


def _wait(ego: "EgoCar", link: Link) -> float:
    return expected_wait_s(link, ego.trip.timing)


def _turning(link: Link, onward: Link) -> float:
    return TURN_PENALTY_S if link.direction_to(onward) != "straight" else 0.0


def next_manoeuvre(ego: "EgoCar") -> NextManoeuvre | None:
    """The next junction where one can choose, and which way the route goes there; or the arrival before it."""
    goal = ego.trip.goal
    if goal is None:
        return None
    near = ego.distance_to_goal()
    if near is not None and ego.segment.kind == "road" and ego.segment.link is goal.link:
        return NextManoeuvre("arrive", goal.name, max(0.0, near))
    distance, links = _route_from_here(ego)
    if ego.segment.exit is None:
        links = [ego.segment.link, *links]
    else:
        distance += links[0].length
    for link, onward in pairwise(links):
        if len(link.movements) > 1:
            return NextManoeuvre(link.direction_to(onward), link.end.name, max(0.0, distance))
        distance += min(way.length for lane in link.lanes for way in lane.connectors.values()) + onward.length
    rest = distance - links[-1].length + goal.s
    return NextManoeuvre("arrive", goal.name, rest)


def surroundings(ego: "EgoCar") -> tuple[SeenVehicle, ...]:
    """Other cars near by, the nearest first."""
    seen = [_seen(ego, other) for other in ego.road.vehicles if other is not ego]
    return tuple(sorted((s for s in seen if s.distance_m <= SURROUNDINGS_M), key=lambda s: s.distance_m))


def _seen(ego: "EgoCar", other: "Car") -> SeenVehicle:
    dx = float(other.position[0] - ego.position[0])
    dy = float(other.position[1] - ego.position[1])
    bearing = wrap_angle(math.atan2(dy, dx) - float(ego.heading))
    position: Literal["ahead", "behind", "left", "right"] = "right" if bearing > 0 else "left"
    if abs(bearing) < math.pi / 4:
        position = "ahead"
    elif abs(bearing) > 3 * math.pi / 4:
        position = "behind"
    return SeenVehicle(position, math.hypot(dx, dy), float(other.speed))


def status_of(ego: "EgoCar") -> VehicleStatus:
    """The present state as a translation is told it."""
    state = ego.state()
    return VehicleStatus(
        speed_kmh=round(state.speed_mps * 3.6, 1),
        speed_limit_kmh=round(state.speed_limit_mps * 3.6, 1),
        lane=state.lane,
        lanes=state.lanes,
        lead_gap_m=round(max(0.0, state.lead_gap_m), 1) if state.lead_gap_m is not None else None,
        traffic_light=state.traffic_light,
        destination=state.destination,
        waypoints=state.waypoints,
        under_way=state.mode is OperationMode.AUTONOMOUS,
        settings=changed_settings(ego),
    )


def changed_settings(ego: "EgoCar") -> dict[str, str]:
    """Driving parameters that aren't at their default, as canonical text."""
    default = DRIVING_PARAMETERS["max_vel"].default
    value = ego.parameters.max_vel
    if not isinstance(default, Measure) or math.isclose(value, default.si, rel_tol=1e-9):
        return {}
    return {"max_vel": f"{round(value / UNITS[default.unit].to_si, 3):g} {default.unit}"}
