"""Lays out the lanes of a map: links, connectors across the junctions, stop lines and conflicts."""

import math
from itertools import pairwise

from wayword.runtime.world.conflicts import find_conflicts
from wayword.runtime.world.geometry import join, wrap_angle
from wayword.runtime.world.maps import LANE_WIDTH_M, JunctionEntry, Map, PlaceEntry, RoadEntry
from wayword.runtime.world.network import Junction, LaneSegment, Link, Movement, Network, Place

STOP_LINE_SETBACK_M = 1.0
"""From the stop line to the edge of the junction."""


def build_network(town: Map) -> Network:
    """Lay out the lanes of a map."""
    junctions = {entry.id: _junction(entry) for entry in town.junctions}
    links: dict[str, Link] = {}
    for road in town.roads:
        for start, end in ((road.start, road.end), (road.end, road.start)):
            link = _link(town, road, junctions[start], junctions[end])
            links[link.id] = link
            link.end.incoming.append(link)
    for junction in junctions.values():
        junction.incoming.sort(key=lambda link: link.heading)
        _connect(junction, links)
    places = {entry.name: _place(town, entry, links) for entry in town.places}
    network = Network(junctions, links, places)
    find_conflicts(network)
    return network


def _junction(entry: JunctionEntry) -> Junction:
    return Junction(entry.id, entry.name, entry.x, entry.y)


def _place(town: Map, entry: PlaceEntry, links: dict[str, Link]) -> Place:
    along = entry.position_m - town.junction_half_size_m
    return Place(entry.name, links[f"{entry.start}>{entry.end}"], along)


def _link(town: Map, road: RoadEntry, start: Junction, end: Junction) -> Link:
    heading = math.atan2(end.y - start.y, end.x - start.x)
    link = Link(f"{start.id}>{end.id}", start, end, road.street, road.limit_kmh / 3.6, heading)
    half = town.junction_half_size_m
    length = town.road_length_m(start.id, end.id) - 2 * half
    axis = join((start.x, start.y), heading, (end.x, end.y), heading)
    for lane in range(road.lanes):
        offset = LANE_WIDTH_M * (lane + 0.5)
        curve = join(axis.point(half, offset), heading, axis.point(half + length, offset), heading)
        index = (f"{link.id}:start", f"{link.id}:end", lane)
        link.lanes.append(LaneSegment(index, "road", curve, link, lane, length))
    for left, right in pairwise(link.lanes):
        left.right, right.left = right, left
    return link


def _connect(junction: Junction, links: dict[str, Link]) -> None:
    """Lay connectors across a junction: left from the innermost lane, right from the outermost, straight from all.

    Where a link can't go straight on and has only one way on, as in a bend, all its lanes take it.
    """
    outgoing = [links[f"{junction.id}>{link.start.id}"] for link in junction.incoming]
    for link in junction.incoming:
        for onward in outgoing:
            if onward.end is not link.start:
                link.movements[_direction(link, onward)] = onward
        for direction, onward in link.movements.items():
            for lane in link.lanes:
                if len(link.movements) == 1 or _allows(direction, lane):
                    junction.connectors.append(_connector(lane, onward.lanes[lane.lane], direction))
        if junction.signalised:
            for lane in link.lanes:
                lane.stop_line = lane.length - STOP_LINE_SETBACK_M


def _direction(link: Link, onward: Link) -> Movement:
    turn = wrap_angle(onward.heading - link.heading)
    if abs(turn) < math.pi / 4:
        return "straight"
    return "right" if turn > 0 else "left"


def _allows(direction: Movement, lane: LaneSegment) -> bool:
    if direction == "left":
        return lane.left is None
    return direction == "straight" or lane.right is None


def _connector(lane: LaneSegment, exit_lane: LaneSegment, direction: Movement) -> LaneSegment:
    start, end = lane.curve.point(lane.length), exit_lane.curve.point(0.0)
    curve = join(start, lane.link.heading, end, exit_lane.link.heading)
    parallel = sum(connector.exit in exit_lane.link.lanes for connector in _connectors_of(lane.link))
    index = (lane.index[1], exit_lane.index[0], parallel)
    connector = LaneSegment(index, "connector", curve, lane.link, lane.lane, curve.length)
    connector.movement, connector.exit, connector.feeders = direction, exit_lane, [lane]
    lane.connectors[direction] = connector
    exit_lane.feeders.append(connector)
    return connector


def _connectors_of(link: Link) -> list[LaneSegment]:
    return [connector for lane in link.lanes for connector in lane.connectors.values()]
