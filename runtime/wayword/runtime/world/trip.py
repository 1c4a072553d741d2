"""The ego's navigation: the goal, the way there, and the passenger's turns on the way."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from wayword.runtime.vehicle import Manoeuvre, ManoeuvreState, Rationale, Refusal
from wayword.runtime.world.maps import SignalTiming
from wayword.runtime.world.network import LaneSegment, Link, Movement, Network, Place
from wayword.runtime.world.router import RouteTable

if TYPE_CHECKING:
    from wayword.runtime.world.car import Car

_LONGEST_ROUTE = 60
"""Links in a route at most; a guard, since every route is a shortest one."""


class TurnRequest:
    """A turn that the passenger wants at a junction.

    Attributes:
        approach: The link that ends at the junction.
        direction: Which way.
        manoeuvre: What the executor watches.
    """

    def __init__(self, approach: Link, direction: Movement) -> None:
        self.approach = approach
        self.direction: Movement = direction
        self.manoeuvre = Manoeuvre("turn", facts={"direction": direction, "junction": approach.end.name})

    def finish(self, state: ManoeuvreState, code: Rationale | None = None) -> None:
        """End it."""
        self.manoeuvre.state = state
        if code is not None:
            self.manoeuvre.refusal = Refusal(code, dict(self.manoeuvre.facts))


class TripNavigator:
    """Leads the ego to its goal. The goal outlives every turn request and every missed turn.

    Attributes:
        goal: The place to reach.
        turn: The turn wanted by the passenger.
        goes_round: Whether the goal on the present link can't be reached any more before the next junction.
    """

    def __init__(self, network: Network, timing: SignalTiming) -> None:
        self._network = network
        self.timing = timing
        self.goal: Place | None = None
        self.turn: TurnRequest | None = None
        self.goes_round = False
        self._table: RouteTable | None = None

    def set_goal(self, place: Place) -> None:
        """Lead to a place from now on."""
        self.goal = place
        self._table = RouteTable(self._network, place.link, self.timing)

    def request_turn(self, turn: TurnRequest) -> None:
        """Take a turn at the next junction; it replaces one asked for earlier."""
        if self.turn is not None:
            self.turn.finish(ManoeuvreState.FAILED, "superseded")
        self.turn = turn

    def cancel_turn(self) -> None:
        """Follow the route again."""
        if self.turn is not None:
            self.turn.finish(ManoeuvreState.FAILED, "cancelled")
            self.turn = None

    def ends_on(self, link: Link, present: Link) -> bool:
        """Whether the trip ends on a link, seen from the present one."""
        if self.goal is None or self.goal.link is not link or self.turn is not None:
            return False
        return not (link is present and self.goes_round)

    def next_link(self, link: Link) -> Link | None:
        """The link to take after a link; None without a goal or turn."""
        return self._next(link, self.turn)

    def _next(self, link: Link, turn: TurnRequest | None) -> Link | None:
        if turn is not None and turn.approach is link:
            return link.movements[turn.direction]
        if len(link.movements) == 1:
            return next(iter(link.movements.values()))
        return None if self._table is None else self._table.onward(link)

    def onward(self, car: "Car", lane: LaneSegment) -> LaneSegment | None:
        """The connector to take: the route's, or from a wrong lane the one that costs least."""
        if self.ends_on(lane.link, car.segment.link):
            return None
        wanted = self.next_link(lane.link)
        ways = list(lane.connectors.values())
        for way in ways:
            if way.exit is not None and way.exit.link is wanted:
                return way
        return min(ways, key=self._cost)

    def _cost(self, connector: LaneSegment) -> float:
        if self._table is None or connector.exit is None:
            return 0.0 if connector.movement == "straight" else 1.0
        return self._table.cost(connector.exit.link)

    def entered(self, car: "Car", segment: LaneSegment) -> None:  # noqa: ARG002 - Navigator
        """Note which way was taken at a junction."""
        if segment.kind == "road":
            self.goes_round = False
            self._judge_turn(segment)

    def _judge_turn(self, lane: LaneSegment) -> None:
        turn = self.turn
        if turn is None or turn.approach.end is not lane.link.start:
            return
        taken = turn.approach.movements[turn.direction] is lane.link
        self.turn = None
        turn.finish(*((ManoeuvreState.DONE,) if taken else (ManoeuvreState.FAILED, "turn_missed")))

    def route(self, link: Link) -> list[Link]:
        """The links from a present one to the one where the trip ends, both included; empty without a goal."""
        if self.goal is None:
            return []
        return list(self._walk(link))

    def _walk(self, link: Link) -> Iterator[Link]:
        turn, goal = self.turn, self.goal.link if self.goal is not None else None
        passes_goal = self.goes_round
        for _ in range(_LONGEST_ROUTE):
            yield link
            if link is goal and turn is None and not passes_goal:
                return
            onward = self._next(link, turn)
            if onward is None:
                return
            if turn is not None and link is turn.approach:
                turn = None
            link, passes_goal = onward, False

    def lanes_for(self, link: Link) -> list[LaneSegment]:
        """The lanes of a link from which the way goes on; at the goal the one at the kerb."""
        if self.ends_on(link, link):
            return link.lanes[-1:]
        wanted = self.next_link(link)
        if wanted is None:
            return link.lanes
        direction = link.direction_to(wanted)
        return [lane for lane in link.lanes if direction in lane.connectors]
