"""The language's tables: every action and driving parameter with its types, bounds and defaults.

The syntax is in ``wayword.lark``; this module says what the words mean. The checker, the knowledge base of the
language model and the documentation all read it. A test holds the two against each other.
"""

from dataclasses import dataclass
from enum import StrEnum

from wayword.compiler.units import UNITS, Dimension


class CommandType(StrEnum):
    """The five categories of interaction, and what lies outside of them."""

    INFORMATION = "INFORMATION"
    MISSION = "MISSION"
    CONFIG = "CONFIG"
    COOPERATION = "COOPERATION"
    INTERVENTION = "INTERVENTION"
    OUT_OF_SCOPE = "OUT_OF_SCOPE"


@dataclass(frozen=True, slots=True)
class Measure:
    """A number with its unit, as the tables write bounds and defaults."""

    number: float
    unit: str

    @property
    def si(self) -> float:
        """The value in SI units."""
        return self.number * UNITS[self.unit].to_si

    @property
    def dimension(self) -> Dimension:
        """What it measures."""
        return UNITS[self.unit].dimension

    def __str__(self) -> str:
        return f"{self.number:g} {self.unit}"


@dataclass(frozen=True, slots=True)
class Bounds:
    """The closed interval that the values of one dimension may lie in. A value at a bound is legal."""

    lower: Measure
    upper: Measure

    @property
    def dimension(self) -> Dimension:
        """The dimension of both ends."""
        return self.lower.dimension

    def contains(self, si: float) -> bool:
        """Whether a value, in SI, lies within, with a relative tolerance of 1e-9 (language.md section 1)."""
        slack = 1e-9 * max(abs(self.lower.si), abs(self.upper.si))
        return self.lower.si - slack <= si <= self.upper.si + slack

    def __str__(self) -> str:
        if self.lower.unit == self.upper.unit:
            return f"{self.lower.number:g} to {self.upper}"
        return f"{self.lower} to {self.upper}"


@dataclass(frozen=True, slots=True)
class Choice:
    """A value that is one of a few words."""

    options: tuple[str, ...]

    def __str__(self) -> str:
        return " | ".join(self.options)


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number with a unit. Several bounds mean that several dimensions are allowed; the first is the default.

    Attributes:
        bounds: One per allowed dimension.
        default_unit: The unit of a number that has none.
    """

    bounds: tuple[Bounds, ...]
    default_unit: str

    @property
    def dimensions(self) -> tuple[Dimension, ...]:
        """The allowed dimensions, the default unit's first."""
        return tuple(bounds.dimension for bounds in self.bounds)

    @property
    def units(self) -> tuple[str, ...]:
        """Every unit that a value may have, the default first."""
        allowed = [unit for dimension in self.dimensions for unit in dimension.units]
        return (self.default_unit, *(unit for unit in allowed if unit != self.default_unit))

    def bounds_of(self, dimension: Dimension) -> Bounds | None:
        """The bounds for values of `dimension`, or None where it isn't allowed."""
        return next((bounds for bounds in self.bounds if bounds.dimension is dimension), None)

    def __str__(self) -> str:
        bounds = " or ".join(str(bounds) for bounds in self.bounds)
        return f"{' or '.join(self.dimensions)} ({bounds}; units {', '.join(self.units)})"


@dataclass(frozen=True, slots=True)
class Place:
    """The name of a place on the map that the vehicle has loaded."""

    def __str__(self) -> str:
        return "place"


ValueType = Choice | Quantity | Place


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of an action.

    Attributes:
        name: Its name in the program.
        type: What its value may be.
        required: Whether it must be given.
    """

    name: str
    type: ValueType
    required: bool = True


@dataclass(frozen=True, slots=True)
class DrivingParameter:
    """A setting of how the car drives (language.md section 3).

    Attributes:
        name: Its name in the program.
        type: What its value may be.
        default: The value at the start of a trip and after ``default``.
        meaning: What it sets, in words.
        step: How far ``increase`` and ``decrease`` move it; None for settings that aren't numbers.
    """

    name: str
    type: Choice | Quantity
    default: Measure | str
    meaning: str
    step: Measure | None = None


class Arguments(StrEnum):
    """Which argument list an action takes."""

    OWN = "own"  # the action's own parameters
    SETTING = "setting"  # exactly one driving parameter with a value or `default`; or `all: default`
    ADJUSTMENT = "adjustment"  # exactly one numeric driving parameter with a step or a signed delta


@dataclass(frozen=True, slots=True)
class Action:
    """An action of the language (language.md section 2).

    Attributes:
        name: Its name in the program.
        command_type: The category it belongs to.
        meaning: What the passenger wants by it, in words.
        parameters: Its own parameters, in canonical order.
        arguments: Which argument list it takes.
    """

    name: str
    command_type: CommandType
    meaning: str
    parameters: tuple[Parameter, ...] = ()
    arguments: Arguments = Arguments.OWN


def _range(lower: float, upper: float, unit: str) -> Bounds:
    return Bounds(Measure(lower, unit), Measure(upper, unit))


_SIDE = Choice(("left", "right"))
_POSITION = Choice(("ahead", "left", "right", "behind"))
_SPEED = Quantity((_range(5, 130, "km/h"),), "km/h")


def _acceleration(lower: float, upper: float) -> Quantity:
    return Quantity((_range(lower, upper, "m/s^2"),), "m/s^2")


_ACCELERATION_STEP = Measure(0.5, "m/s^2")

DRIVING_PARAMETERS: dict[str, DrivingParameter] = {
    parameter.name: parameter
    for parameter in (
        DrivingParameter("max_vel", _SPEED, Measure(130, "km/h"), "highest speed wanted", step=Measure(10, "km/h")),
        DrivingParameter(
            "following_distance",
            Quantity((_range(1.0, 5.0, "s"), _range(5, 150, "m")), "s"),
            Measure(1.8, "s"),
            "distance to the car ahead while driving",
            step=Measure(0.5, "s"),
        ),
        DrivingParameter(
            "min_gap",
            Quantity((_range(1.5, 10, "m"),), "m"),
            Measure(2, "m"),
            "gap to the car ahead when standing",
            step=Measure(1, "m"),
        ),
        DrivingParameter(
            "max_accel",
            _acceleration(0.3, 3.0),
            Measure(1.5, "m/s^2"),
            "how hard to accelerate",
            step=_ACCELERATION_STEP,
        ),
        DrivingParameter(
            "max_decel",
            _acceleration(1.0, 4.0),
            Measure(2.0, "m/s^2"),
            "how hard to brake in comfort",
            step=_ACCELERATION_STEP,
        ),
        DrivingParameter(
            "max_lat_accel",
            _acceleration(0.5, 3.0),
            Measure(2.0, "m/s^2"),
            "how hard to take curves",
            step=_ACCELERATION_STEP,
        ),
        DrivingParameter("driving_style", Choice(("calm", "normal", "sporty")), "normal", "mood of the whole driving"),
        DrivingParameter("preferred_lane", Choice(("left", "right", "any")), "any", "lane to use by preference"),
        DrivingParameter("lane_changes", Choice(("avoid", "normal", "eager")), "normal", "how readily to change lanes"),
    )
}

DRIVING_STYLES: dict[str, dict[str, Measure]] = {
    "calm": {
        "max_accel": Measure(1.0, "m/s^2"),
        "max_decel": Measure(1.5, "m/s^2"),
        "max_lat_accel": Measure(1.2, "m/s^2"),
        "following_distance": Measure(2.5, "s"),
    },
    "normal": {
        name: default
        for name in ("max_accel", "max_decel", "max_lat_accel", "following_distance")
        if isinstance(default := DRIVING_PARAMETERS[name].default, Measure)
    },
    "sporty": {
        "max_accel": Measure(2.5, "m/s^2"),
        "max_decel": Measure(3.0, "m/s^2"),
        "max_lat_accel": Measure(3.0, "m/s^2"),
        "following_distance": Measure(1.2, "s"),
    },
}
"""What each driving_style presets."""

QUERY_ITEMS = (
    "speed",
    "speed_limit",
    "destination",
    "eta",
    "remaining_distance",
    "position",
    "lane",
    "lead_gap",
    "next_maneuver",
    "traffic_light",
    "operation_mode",
    "settings",
    "surroundings",
    "reason",
)

_I, _M, _C = CommandType.INFORMATION, CommandType.MISSION, CommandType.CONFIG
_CO, _IV, _O = CommandType.COOPERATION, CommandType.INTERVENTION, CommandType.OUT_OF_SCOPE

ACTIONS: dict[str, Action] = {
    action.name: action
    for action in (
        Action("QUERY", _I, "a question about the car or the trip", (Parameter("item", Choice(QUERY_ITEMS)),)),
        Action("SET_DESTINATION", _M, "set the goal of the trip", (Parameter("destination", Place()),)),
        Action("ADD_WAYPOINT", _M, "call at a place on the way", (Parameter("waypoint", Place()),)),
        Action(
            "REMOVE_WAYPOINT",
            _M,
            "leave out a place on the way, or all of them",
            (Parameter("waypoint", Place(), required=False),),
        ),
        Action("START", _M, "start driving, go on with the trip"),
        Action("STOP", _M, "stop driving, end the trip, without urgency"),
        Action("SET_PARAM", _C, "set one driving parameter", arguments=Arguments.SETTING),
        Action("ADJUST_PARAM", _C, "change one driving parameter by some", arguments=Arguments.ADJUSTMENT),
        Action("CHANGE_LANE", _CO, "change the lane once, now", (Parameter("direction", _SIDE),)),
        Action("OVERTAKE", _CO, "pass the car ahead", (Parameter("side", _SIDE, required=False),)),
        Action(
            "TURN",
            _CO,
            "which way to go at the next intersection",
            (Parameter("direction", Choice(("left", "right", "straight", "around"))),),
        ),
        Action(
            "TAKE_EXIT",
            _CO,
            "leave the highway or roundabout",
            (Parameter("number", Choice(("1", "2", "3", "4", "5"))),),
        ),
        Action("PULL_OVER", _CO, "stop at the side of the road, park"),
        Action("KEEP_LANE", _CO, "stay in this lane, call off a lane change"),
        Action("GIVE_WAY", _CO, "let another road user go first"),
        Action(
            "OVERRIDE_TRAFFIC_LIGHT",
            _IV,
            "the light really shows this colour",
            (Parameter("state", Choice(("green", "red"))),),
        ),
        Action("OVERRIDE_SPEED_LIMIT", _IV, "the sign really shows this limit", (Parameter("limit", _SPEED),)),
        Action(
            "IGNORE_OBJECT",
            _IV,
            "what the car sees there is nothing or harmless",
            (Parameter("position", _POSITION),),
        ),
        Action(
            "REPORT_OBJECT",
            _IV,
            "there is something there that the car has not seen",
            (
                Parameter("position", _POSITION),
                Parameter("distance", Quantity((_range(1, 200, "m"),), "m"), required=False),
            ),
        ),
        Action("PROCEED", _IV, "the way is free, no need to wait"),
        Action("EMERGENCY_STOP", _IV, "stop at once, danger"),
        Action(
            "REJECT",
            _O,
            "the car must not or cannot do this",
            (Parameter("reason", Choice(("unrelated", "unsupported", "unsafe", "unknown_place"))),),
        ),
        Action(
            "CLARIFY",
            _O,
            "something needed was not said",
            (Parameter("about", Choice(("command", "destination", "direction", "parameter", "value"))),),
        ),
    )
}
