"""The lane graph: links between junctions, their lanes, and the connectors that lead across the junctions."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

from wayword.runtime.world.geometry import Curve, Point

Movement = Literal["left", "right", "straight"]
"""A way across a junction."""

LaneIndex = tuple[str, str, int]
"""How highway-env names a lane: node, node, number.

The classes below refer to each other in circles, so that each names itself by its identifier alone.
"""


@dataclass(eq=False, repr=False, slots=True)
class Junction:
    """Where links meet.

    Attributes:
        id: As in the map.
        name: As in the map.
        x: East of the origin, in m.
        y: South of the origin, in m.
        incoming: Links that lead to it, clockwise from the north-west in the order of their headings.
        connectors: Lanes across it.
    """

    id: str
    name: str
    x: float
    y: float
    incoming: list["Link"] = field(default_factory=list)
    connectors: list["LaneSegment"] = field(default_factory=list)

    def __repr__(self) -> str:
        return f"<Junction {self.id}>"

    @property
    def signalised(self) -> bool:
        """Whether it has traffic lights: every junction of three or more arms has."""
        return len(self.incoming) > 2


@dataclass(eq=False, repr=False, slots=True)
class Link:
    """One direction of a road between two junctions.

    Attributes:
        id: ``start>end``.
        start: Where it comes from.
        end: Where it leads to.
        street: Name of the street.
        limit_mps: Legal limit.
        heading: Its direction, in rad.
        lanes: Its lanes from left to right.
        movements: The links that it leads on to.
    """

    id: str
    start: Junction
    end: Junction
    street: str
    limit_mps: float
    heading: float
    lanes: list["LaneSegment"] = field(default_factory=list)
    movements: dict[Movement, "Link"] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<Link {self.id}>"

    @property
    def length(self) -> float:
        """Length between the two junctions' edges, in m."""
        return self.lanes[0].length

    def direction_to(self, onward: "Link") -> Movement:
        """Which way one has to go at the end to get on to `onward`."""
        return next(direction for direction, link in self.movements.items() if link is onward)


@dataclass(eq=False, repr=False, slots=True)
class LaneSegment:
    """One lane of a link, or one connector across a junction.

    Attributes:
        index: Its name in highway-env.
        kind: ``"road"`` or ``"connector"``.
        curve: Its centre line.
        link: The link that it belongs to; for a connector the one that it comes from.
        lane: Number from the left, from 0.
        length: In m.
        stop_line: Where the stop line is, in m along; None without traffic lights and on connectors.
        left: Lane to the left in the same direction.
        right: Lane to the right in the same direction.
        connectors: Ways on from a lane.
        movement: Which way a connector leads.
        exit: The lane that a connector leads to.
        feeders: What leads to this segment: connectors to a lane, a lane to a connector.
        conflicts: Connectors from other links that cross this one or join it.
        siblings: Connectors from the same lane, each with how far along a car on it is still in this one's way.
    """

    index: LaneIndex
    kind: Literal["road", "connector"]
    curve: Curve
    link: Link
    lane: int
    length: float
    stop_line: float | None = None
    left: "LaneSegment | None" = None
    right: "LaneSegment | None" = None
    connectors: "dict[Movement, LaneSegment]" = field(default_factory=dict)
    movement: Movement | None = None
    exit: "LaneSegment | None" = None
    feeders: "list[LaneSegment]" = field(default_factory=list)
    conflicts: "tuple[LaneSegment, ...]" = ()
    siblings: "tuple[tuple[LaneSegment, float], ...]" = ()

    def __repr__(self) -> str:
        return f"<LaneSegment {self.index}>"

    @property
    def junction(self) -> Junction:
        """The junction at its end, or the one that a connector crosses."""
        return self.link.end

    @property
    def limit_mps(self) -> float:
        """Legal limit."""
        return self.link.limit_mps

    def neighbour(self, side: Literal["left", "right"]) -> "LaneSegment | None":
        """The lane on one side in the same direction."""
        return self.left if side == "left" else self.right


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """A place, on the lane graph.

    Attributes:
        name: Its name in the language.
        link: The link at whose right-hand kerb it lies.
        s: Distance along the link, in m.
    """

    name: str
    link: Link
    s: float

    @property
    def point(self) -> Point:
        """Where a car that has arrived there is, in m."""
        return self.link.lanes[-1].curve.point(self.s)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Network:
    """A map's lane graph.

    Attributes:
        junctions: By identifier.
        links: By identifier.
        places: By name.
    """

    junctions: dict[str, Junction]
    links: dict[str, Link]
    places: dict[str, Place]

    def segments(self) -> Iterator[LaneSegment]:
        """Every lane and connector, in a fixed order."""
        for link in self.links.values():
            yield from link.lanes
        for junction in self.junctions.values():
            yield from junction.connectors
