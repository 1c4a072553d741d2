"""Routes: Dijkstra's algorithm over links, backwards from the goal."""

import heapq
import itertools

from wayword.runtime.world.maps import SignalTiming
from wayword.runtime.world.network import Link, Network

TURN_PENALTY_S = 3.0
"""Slowing down for a turn and getting up to speed again."""


def expected_wait_s(link: Link, timing: SignalTiming) -> float:
    """Mean wait at the end of a link: a red of length r in a cycle of length c costs r²/(2c) on average."""
    if not link.end.signalised:
        return 0.0
    cycle = timing.phase_s * len(link.end.incoming)
    red = cycle - timing.green_s
    return red * red / (2 * cycle)


class RouteTable:
    """The best way from every link to a goal link.

    Attributes:
        goal: The link that all ways lead to.
    """

    def __init__(self, network: Network, goal: Link, timing: SignalTiming) -> None:
        self.goal = goal
        self._timing = timing
        self._cost = {goal: 0.0}
        self._search(network)

    def _search(self, network: Network) -> None:
        incoming: dict[Link, list[Link]] = {link: [] for link in network.links.values()}
        for link in network.links.values():
            for onward in link.movements.values():
                incoming[onward].append(link)
        order = itertools.count()  # ties are broken by age, never by comparing links
        queue = [(0.0, next(order), self.goal)]
        while queue:
            cost, _, onward = heapq.heappop(queue)
            if cost > self._cost[onward]:
                continue
            for link in incoming[onward]:
                through = cost + self._crossing_cost(link, onward)
                if through < self._cost.get(link, float("inf")):
                    self._cost[link] = through
                    heapq.heappush(queue, (through, next(order), link))

    def _crossing_cost(self, link: Link, onward: Link) -> float:
        """Time from the start of `link` to the start of `onward`, in s."""
        cost = link.length / link.limit_mps + expected_wait_s(link, self._timing)
        return cost + (TURN_PENALTY_S if link.direction_to(onward) != "straight" else 0.0)

    def cost(self, link: Link) -> float:
        """Time from the start of a link to the start of the goal link, in s."""
        return self._cost[link]

    def onward(self, link: Link) -> Link:
        """The link to take after `link`; from the goal link, the one that leads back to it."""
        return min(link.movements.values(), key=lambda onward: self._crossing_cost(link, onward) + self._cost[onward])
