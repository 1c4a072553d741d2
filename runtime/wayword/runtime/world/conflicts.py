"""Which connectors of a junction get in each other's way, found by sampling their centre lines."""

from wayword.runtime.world.geometry import distance_to, sample
from wayword.runtime.world.network import Junction, LaneSegment, Network

CONFLICT_DISTANCE_M = 3.5
"""Centre lines nearer than this can't be used side by side: a car is 2 m wide and its front swings out in turns."""
SIBLING_DISTANCE_M = 2.8
"""A car ahead on a diverging connector is in the way while its tail is nearer than this to our centre line."""
SPACING_M = 1.0


def find_conflicts(network: Network) -> None:
    """Fill in ``conflicts`` and ``siblings`` of every connector."""
    for junction in network.junctions.values():
        _find_conflicts_at(junction)


def _find_conflicts_at(junction: Junction) -> None:
    points = {connector: sample(connector.curve, SPACING_M) for connector in junction.connectors}

    def near(one: LaneSegment, other: LaneSegment) -> bool:
        return any(distance_to(points[other], point) < CONFLICT_DISTANCE_M for point in points[one])

    def shared_length(one: LaneSegment, other: LaneSegment) -> float:
        spacing = other.length / (len(points[other]) - 1)
        shared = [i for i, p in enumerate(points[other]) if distance_to(points[one], p) < SIBLING_DISTANCE_M]
        return max(shared, default=0) * spacing

    for one in junction.connectors:
        others = [other for other in junction.connectors if other is not one]
        one.conflicts = tuple(other for other in others if other.link is not one.link and near(one, other))
        one.siblings = tuple(
            (other, shared_length(one, other)) for other in others if other.link is one.link and other.lane == one.lane
        )
