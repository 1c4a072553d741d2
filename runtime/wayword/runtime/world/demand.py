"""What a constraint of the planner asks for."""

from collections.abc import Mapping
from typing import NamedTuple

from wayword.runtime.vehicle import Constraint, FactValue


class Demand(NamedTuple):
    """The acceleration that one constraint allows at most.

    Attributes:
        acceleration: In m/s².
        constraint: Its name, one of those of :class:`~wayword.runtime.vehicle.Binding`.
        facts: Numbers and names behind it.
        urgent: Whether comfort doesn't count, so that the jerk isn't limited.
    """

    acceleration: float
    constraint: Constraint
    facts: Mapping[str, FactValue]
    urgent: bool = False


def kmh(speed: float) -> float:
    """A speed in km/h, rounded for telling."""
    return round(speed * 3.6, 1)
