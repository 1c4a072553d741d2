"""The passenger's turns and lane changes: what can be asked for when, and what comes of it."""

from typing import TYPE_CHECKING

from wayword.runtime.vehicle import Manoeuvre, OperationMode, Refusal, Side, TurnDirection
from wayword.runtime.world.lane_change import INDICATE_S, LaneChange, length_needed, room_ahead
from wayword.runtime.world.network import LaneSegment, Link, Movement
from wayword.runtime.world.trip import TurnRequest

if TYPE_CHECKING:
    from wayword.runtime.world.ego import EgoCar


def turn(ego: "EgoCar", direction: TurnDirection) -> Manoeuvre | Refusal:
    """Ask for a turn at the next junction of three or more arms."""
    if direction == "around":
        return Refusal("unsupported_turn", {"direction": direction})
    if ego.mode is not OperationMode.AUTONOMOUS:
        return Refusal("not_under_way")
    approach = _next_approach(ego)
    if approach is None:
        return Refusal("no_junction_ahead")
    facts = {"direction": direction, "junction": approach.end.name}
    if direction not in approach.movements:
        return Refusal("turn_not_possible", facts)
    if not _in_time(ego, approach, direction):
        return Refusal("too_close_to_junction", facts)
    request = TurnRequest(approach, direction)
    ego.trip.request_turn(request)
    _drop_route_lane_change(ego)
    ego.replan()
    return request.manoeuvre


def _next_approach(ego: "EgoCar") -> Link | None:
    """The link that leads to the next junction where one can choose, bends being followed."""
    link = ego.segment.link
    connector = ego.connector_entered()
    if connector is not None and connector.exit is not None:
        link = connector.exit.link
    for _ in ego.scene.network.links:
        if len(link.movements) > 1:
            return link
        link = next(iter(link.movements.values()))
    return None


def _in_time(ego: "EgoCar", approach: Link, direction: Movement) -> bool:
    """Whether the car can still brake for the turn and get into a lane for it."""
    if ego.segment.kind != "road" or ego.segment.link is not approach:
        return True
    if ego.connector_entered() is not None or room_ahead(ego) < 0.0:
        return False
    connector = ego.segment.connectors.get(direction)
    if connector is None:
        return room_ahead(ego) >= length_needed(ego, INDICATE_S)
    return ego.can_take(connector)


def _drop_route_lane_change(ego: "EgoCar") -> None:
    if ego.lane_change is not None and ego.lane_change.purpose == "route":
        ego.lane_change.call_off(ego, "superseded")


def lane_change(ego: "EgoCar", side: Side) -> Manoeuvre | Refusal:
    """Ask for a lane change."""
    if ego.mode is not OperationMode.AUTONOMOUS:
        return Refusal("not_under_way")
    lane = _lane_to_leave(ego)
    if lane.neighbour(side) is None:
        return Refusal("no_such_lane", {"side": side})
    if lane is not ego.segment or room_ahead(ego) < length_needed(ego, INDICATE_S):
        return Refusal("too_close_to_junction", {"side": side, "junction": ego.segment.junction.name})
    if ego.lane_change is not None:
        if ego.lane_change.moving:
            return Refusal("changing_lane", {"side": ego.lane_change.side})
        ego.lane_change.call_off(ego, "superseded")
    ego.lane_change = LaneChange(ego, side, "request")
    ego.keep_lane_on(lane.link)
    return ego.lane_change.manoeuvre


def _lane_to_leave(ego: "EgoCar") -> LaneSegment:
    """The lane that the car is on, or inside a junction the one that it comes to."""
    if ego.segment.exit is not None:
        return ego.segment.exit
    return ego.segment


def cancel(ego: "EgoCar", manoeuvre: Manoeuvre) -> None:
    """Call off a turn or a lane change that has not begun to happen."""
    change, request = ego.lane_change, ego.trip.turn
    if change is not None and change.manoeuvre is manoeuvre:
        change.call_off(ego, "cancelled")
    elif request is not None and request.manoeuvre is manoeuvre:
        ego.trip.cancel_turn()
        ego.recheck_goal()
