"""Dimensions and units: what a number with a unit means in SI."""

from dataclasses import dataclass
from enum import StrEnum


class Dimension(StrEnum):
    """The physical dimensions that the language knows."""

    SPEED = "speed"
    TIME = "time"
    LENGTH = "length"
    ACCELERATION = "acceleration"

    @property
    def si_unit(self) -> str:
        """The unit that values of this dimension have in instructions."""
        return _SI_UNITS[self]

    @property
    def units(self) -> tuple[str, ...]:
        """The units that a program may use, the canonical default first."""
        return tuple(unit.name for unit in UNITS.values() if unit.dimension is self)


_SI_UNITS = {
    Dimension.SPEED: "m/s",
    Dimension.TIME: "s",
    Dimension.LENGTH: "m",
    Dimension.ACCELERATION: "m/s^2",
}


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of measurement.

    Attributes:
        name: How it is spelt in a program.
        dimension: What it measures.
        to_si: The factor that turns a number in this unit into SI.
    """

    name: str
    dimension: Dimension
    to_si: float


UNITS: dict[str, Unit] = {
    unit.name: unit
    for unit in (
        Unit("km/h", Dimension.SPEED, 1 / 3.6),
        Unit("mph", Dimension.SPEED, 0.44704),  # exact: 1609.344 m / 3600 s
        Unit("m/s", Dimension.SPEED, 1.0),
        Unit("s", Dimension.TIME, 1.0),
        Unit("m", Dimension.LENGTH, 1.0),
        Unit("ft", Dimension.LENGTH, 0.3048),  # exact, international foot
        Unit("m/s^2", Dimension.ACCELERATION, 1.0),
    )
}
