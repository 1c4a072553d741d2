"""How one driver drives, in SI. Defaults come from the language's table, so that the two can't disagree."""

from dataclasses import dataclass, replace

import numpy as np

from wayword.compiler.vocabulary import DRIVING_PARAMETERS, Measure


def _default(name: str) -> float:
    default = DRIVING_PARAMETERS[name].default
    if not isinstance(default, Measure):
        raise TypeError(f"{name} has no number as its default")
    return default.si


@dataclass(frozen=True, slots=True)
class DriverParameters:
    """Settings of the planner.

    Attributes:
        max_vel: Highest speed wanted, in m/s.
        time_gap: Time gap to the car ahead, in s.
        min_gap: Gap to it at standstill, in m.
        max_accel: In m/s².
        max_decel: Comfortable braking, in m/s².
        max_lat_accel: In curves, in m/s².
    """

    max_vel: float = _default("max_vel")
    time_gap: float = _default("following_distance")
    min_gap: float = _default("min_gap")
    max_accel: float = _default("max_accel")
    max_decel: float = _default("max_decel")
    max_lat_accel: float = _default("max_lat_accel")

    def with_max_vel(self, max_vel: float) -> "DriverParameters":
        """The same with another highest speed, in m/s."""
        return replace(self, max_vel=max_vel)


def random_driver(rng: np.random.Generator) -> DriverParameters:
    """Another driver of the town, around the defaults."""
    return DriverParameters(
        max_vel=float(rng.uniform(10.0, 16.0)),
        time_gap=float(rng.uniform(1.2, 2.2)),
        min_gap=float(rng.uniform(1.8, 3.0)),
        max_accel=float(rng.uniform(1.2, 2.0)),
        max_decel=float(rng.uniform(1.6, 2.4)),
        max_lat_accel=float(rng.uniform(1.5, 2.4)),
    )
