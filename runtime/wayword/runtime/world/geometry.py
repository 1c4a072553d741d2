"""Plane curves that lanes are made of, in plain floats.

x grows to the east and y to the south, so a heading grows clockwise and "right of the curve" is positive: a positive
curvature bends to the right, a positive lateral offset lies to the right.
"""

import math
from dataclasses import dataclass, field
from functools import cached_property

Point = tuple[float, float]


def wrap_angle(angle: float) -> float:
    """The same angle within [-pi, pi)."""
    return (angle + math.pi) % (2 * math.pi) - math.pi


@dataclass(frozen=True)
class Line:
    """A straight piece.

    Attributes:
        x: Start, in m.
        y: Start, in m.
        heading: Direction, in rad.
        length: In m.
    """

    x: float
    y: float
    heading: float
    length: float
    curvature: float = field(default=0.0, init=False)

    @cached_property
    def _direction(self) -> Point:
        return math.cos(self.heading), math.sin(self.heading)

    def heading_at(self, _s: float) -> float:
        """Direction at arc length `_s`, in rad."""
        return self.heading

    def point(self, s: float, offset: float = 0.0) -> Point:
        """The point at arc length `s` and lateral `offset`, both in m."""
        cos, sin = self._direction
        return self.x + s * cos - offset * sin, self.y + s * sin + offset * cos

    def project(self, x: float, y: float) -> Point:
        """Arc length and lateral offset of a point, both in m."""
        cos, sin = self._direction
        dx, dy = x - self.x, y - self.y
        return dx * cos + dy * sin, dy * cos - dx * sin


@dataclass(frozen=True)
class Arc:
    """A piece of a circle.

    Attributes:
        x: Start, in m.
        y: Start, in m.
        heading: Direction at the start, in rad.
        length: In m.
        curvature: In 1/m, positive to the right; not zero.
    """

    x: float
    y: float
    heading: float
    length: float
    curvature: float

    @cached_property
    def centre(self) -> Point:
        """Centre of the circle."""
        return (
            self.x - math.sin(self.heading) / self.curvature,
            self.y + math.cos(self.heading) / self.curvature,
        )

    def heading_at(self, s: float) -> float:
        """Direction at arc length `s`, in rad."""
        return self.heading + s * self.curvature

    def point(self, s: float, offset: float = 0.0) -> Point:
        """The point at arc length `s` and lateral `offset`, both in m."""
        heading = self.heading_at(s)
        reach = 1 / self.curvature - offset
        return self.centre[0] + reach * math.sin(heading), self.centre[1] - reach * math.cos(heading)

    def project(self, x: float, y: float) -> Point:
        """Arc length and lateral offset of a point within half a turn of the start, both in m."""
        sign = math.copysign(1.0, self.curvature)
        ux, uy = x - self.centre[0], y - self.centre[1]
        turned = wrap_angle(math.atan2(sign * ux, -sign * uy) - self.heading)
        return turned / self.curvature, 1 / self.curvature - sign * math.hypot(ux, uy)


Curve = Line | Arc


def join(start: Point, heading: float, end: Point, end_heading: float) -> Curve:
    """The line or quarter circle from one pose to another, where one exists.

    Raises:
        ValueError: If neither a line nor an arc joins the two.
    """
    turn = wrap_angle(end_heading - heading)
    dx, dy = end[0] - start[0], end[1] - start[1]
    chord = math.hypot(dx, dy)
    if abs(turn) < 1e-9:
        curve: Curve = Line(start[0], start[1], heading, chord)
    else:
        radius = chord / (2 * math.sin(abs(turn) / 2))
        curve = Arc(start[0], start[1], heading, radius * abs(turn), math.copysign(1 / radius, turn))
    reached = curve.point(curve.length)
    if math.dist(reached, end) > 1e-6:
        raise ValueError(f"no line or arc joins {start} to {end}")
    return curve


def sample(curve: Curve, spacing: float) -> list[Point]:
    """Points along a curve, both ends included, at most `spacing` metres apart."""
    count = max(1, math.ceil(curve.length / spacing))
    return [curve.point(curve.length * i / count) for i in range(count + 1)]


def distance_to(points: list[Point], point: Point) -> float:
    """Least distance from a point to sampled points, in m."""
    return min(math.dist(other, point) for other in points)
