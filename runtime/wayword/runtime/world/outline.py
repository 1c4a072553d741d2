"""The shape of a map, for drawing it. Needs no simulator."""

from dataclasses import dataclass

from wayword.runtime.world.geometry import Point, sample
from wayword.runtime.world.layout import build_network
from wayword.runtime.world.maps import LANE_WIDTH_M, Map

_ARC_SPACING_M = 1.0
_POST_SETBACK_M = 1.0


@dataclass(frozen=True, slots=True)
class LightPost:
    """A traffic light, beyond the right end of its stop line.

    Attributes:
        junction: Identifier of the junction.
        approach: Identifier of the junction that the approach comes from.
        point: Where it stands, in m.
    """

    junction: str
    approach: str
    point: Point


@dataclass(frozen=True, slots=True)
class Outline:
    """What there is to draw, all in m, y growing to the south.

    Attributes:
        lanes: Centre lines of the lanes of all roads.
        connectors: Centre lines across the junctions.
        edges: The outer edges and middle lines of the roads, as segments.
        stop_lines: Stop lines, by their two ends.
        lights: Traffic lights, in the same order.
        places: Where a car that has arrived at a place stands.
        junctions: Middles of the junctions by identifier.
        lane_width_m: Width of a lane.
    """

    lanes: tuple[tuple[Point, ...], ...]
    connectors: tuple[tuple[Point, ...], ...]
    edges: tuple[tuple[Point, Point], ...]
    stop_lines: tuple[tuple[Point, Point], ...]
    lights: tuple[LightPost, ...]
    places: dict[str, Point]
    junctions: dict[str, Point]
    lane_width_m: float = LANE_WIDTH_M


def outline_of(town: Map) -> Outline:
    """The shape of a map."""
    network = build_network(town)
    half = LANE_WIDTH_M / 2
    lanes: list[tuple[Point, ...]] = []
    edges: list[tuple[Point, Point]] = []
    stop_lines: list[tuple[Point, Point]] = []
    lights: list[LightPost] = []
    for link in network.links.values():
        lanes += [(lane.curve.point(0.0), lane.curve.point(lane.length)) for lane in link.lanes]
        inner, outer = link.lanes[0].curve, link.lanes[-1].curve
        edges.append((inner.point(0.0, -half), inner.point(link.length, -half)))
        edges.append((outer.point(0.0, half), outer.point(link.length, half)))
        line = link.lanes[0].stop_line
        if line is not None:
            stop_lines.append((inner.point(line, -half), outer.point(line, half)))
            lights.append(LightPost(link.end.id, link.start.id, outer.point(line, half + _POST_SETBACK_M)))
    connectors = tuple(
        tuple(sample(connector.curve, _ARC_SPACING_M))
        for junction in network.junctions.values()
        for connector in junction.connectors
    )
    return Outline(
        lanes=tuple(lanes),
        connectors=connectors,
        edges=tuple(edges),
        stop_lines=tuple(stop_lines),
        lights=tuple(lights),
        places={name: place.point for name, place in network.places.items()},
        junctions={junction.id: (junction.x, junction.y) for junction in network.junctions.values()},
    )
