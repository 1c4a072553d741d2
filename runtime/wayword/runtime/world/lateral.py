"""Steering along a lane and planned lane changes.

The path is followed with the rear axle. In highway-env's bicycle model the rear axle lies half a car's length behind
the centre and its path has the curvature tan(steering) / length.
"""

import math
from dataclasses import dataclass

from wayword.runtime.vehicle import Side
from wayword.runtime.world.geometry import wrap_angle
from wayword.runtime.world.network import LaneSegment

LENGTH_M = 5.0
AXLE_M = LENGTH_M / 2
"""From the centre back to the rear axle, which is the rear bumper too."""
MAX_STEERING_RAD = 0.6

LANE_CHANGE_S = 4.0
"""Duration of the lateral motion; UN R79 wants 3 to 5 s."""
SHORTEST_LANE_CHANGE_M = 14.0
"""A slow car stretches a lane change over this length, since it can't move sideways without moving on."""
CLEAR_OF_LANE = 0.8
"""Share of the lane change after which the car has left its old lane."""

_SMOOTHING_M = 2.5
_CONVERGENCE_S = 0.6
_LEAST_CONVERGENCE_M = 4.0


@dataclass(slots=True)
class LaneShift:
    """A lane change in motion: the reference moves from the old lane's centre to the new one's.

    The share q of the way is the quintic 10p³ - 15p⁴ + 6p⁵ of the progress p, the polynomial with the least jerk
    between two rests (Takahashi et al., 1989).

    Attributes:
        side: Where it goes.
        origin: The lane left.
        start_offset: Lateral offset from the new lane's centre at the beginning, in m.
        progress: From 0 to 1.
    """

    side: Side
    origin: LaneSegment
    start_offset: float
    progress: float = 0.0

    def advance(self, speed: float, dt: float) -> None:
        """Move on by a time step."""
        self.progress = min(1.0, self.progress + self._rate(speed) * speed * dt)

    def _rate(self, speed: float) -> float:
        """Progress per metre driven."""
        return 1.0 / max(SHORTEST_LANE_CHANGE_M, LANE_CHANGE_S * speed)

    def reference(self, speed: float) -> tuple[float, float, float]:
        """Lateral offset in m, its slope, and its curvature in 1/m, all relative to the new lane's centre."""
        p, rate = self.progress, self._rate(speed)
        share = p**3 * (10.0 - 15.0 * p + 6.0 * p * p)
        slope = 30.0 * p * p * (1.0 - p) ** 2
        curvature = 60.0 * p * (1.0 - p) * (1.0 - 2.0 * p)
        start = self.start_offset
        return start * (1.0 - share), -start * slope * rate, -start * curvature * rate * rate

    @property
    def clear_of_origin(self) -> bool:
        """Whether the car no longer takes room in its old lane."""
        return self.progress > CLEAR_OF_LANE


@dataclass(frozen=True, slots=True)
class PathView:
    """The path around the rear axle.

    Attributes:
        previous: The segment before the present one.
        current: The segment that the rear axle is on.
        following: The segment after it.
        s: Where the rear axle is along the present one, in m.
    """

    previous: LaneSegment | None
    current: LaneSegment
    following: LaneSegment | None
    s: float

    def heading_at(self, ahead: float) -> float:
        """Direction of the path at a distance ahead of the rear axle, in rad."""
        s = self.s + ahead
        if s < 0.0 and self.previous is not None:
            return self.previous.curve.heading_at(max(0.0, self.previous.length + s))
        if s > self.current.length and self.following is not None:
            return self.following.curve.heading_at(s - self.current.length)
        return self.current.curve.heading_at(s)

    def smooth_curvature(self, ahead: float) -> float:
        """Mean curvature over a window, in 1/m: it lets the wheels turn gradually where a line meets an arc."""
        turn = wrap_angle(self.heading_at(ahead + _SMOOTHING_M) - self.heading_at(ahead - _SMOOTHING_M))
        return turn / (2 * _SMOOTHING_M)


def path_curvature(view: PathView, heading: float, offset: float, speed: float, shift: LaneShift | None) -> float:
    """Curvature to steer, in 1/m: the path's own, and a critically damped return to it.

    With small errors the lateral offset obeys e'' = curvature - path curvature over the distance driven, so
    -e/λ² - 2e'/λ brings it back over the length λ without overshoot.

    Args:
        view: The path.
        heading: The car's heading, in rad.
        offset: Lateral offset of the rear axle from the lane's centre, in m.
        speed: In m/s.
        shift: The lane change in motion.
    """
    reference, slope, bend = shift.reference(speed) if shift is not None else (0.0, 0.0, 0.0)
    heading_error = wrap_angle(heading - view.heading_at(0.0) - math.atan(slope))
    convergence = max(_LEAST_CONVERGENCE_M, _CONVERGENCE_S * speed)
    correction = (offset - reference) / convergence**2 + 2.0 * math.sin(heading_error) / convergence
    return view.smooth_curvature(0.0) + bend - correction


def steering_for(curvature: float) -> float:
    """Steering angle for a curvature of the rear axle's path, in rad."""
    angle = math.atan(LENGTH_M * curvature)
    return max(-MAX_STEERING_RAD, min(MAX_STEERING_RAD, angle))
