"""The seam between the executor and a driving stack.

The executor, the validator and the co-pilot know a vehicle only by :class:`VehicleInterface`. The simulated town car
implements it on highway-env; another stack implements it by other means. All quantities are SI; a lane number counts
from 1 at the left of the present direction of travel.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Literal, Protocol

from wayword.compiler.status import VehicleStatus

Side = Literal["left", "right"]
TurnDirection = Literal["left", "right", "straight", "around"]
LightState = Literal["green", "yellow", "red"]
FactValue = str | float | int | None

Rationale = Literal[
    # the validator
    "not_supported",
    "unsupported_parameter",
    "unsupported_turn",
    "not_under_way",
    "no_destination",
    "unknown_place",
    "no_such_lane",
    "no_traffic_light",
    # the vehicle, at once
    "emergency_braking",
    "already_there",
    "no_junction_ahead",
    "turn_not_possible",
    "too_close_to_junction",
    "changing_lane",
    # the vehicle, in the course of a manoeuvre
    "no_gap",
    "turn_missed",
    # the executor
    "timeout",
    "superseded",
    "cancelled",
    "earlier_command_failed",
    # what the passenger asked for lies out of scope, or is not clear
    "reject_unrelated",
    "reject_unsupported",
    "reject_unsafe",
    "reject_unknown_place",
    "clarify_command",
    "clarify_destination",
    "clarify_direction",
    "clarify_parameter",
    "clarify_value",
]
"""Why a command did not succeed. ``texts/en.yaml`` has a sentence for each that its outcome does not tell already."""

Constraint = Literal[
    "free_road",
    "speed_limit",
    "max_vel",
    "curve",
    "leader",
    "red_light",
    "yellow_light",
    "junction_occupied",
    "exit_blocked",
    "destination",
    "parked",
    "stopping",
    "emergency",
]
"""What can limit the vehicle's motion."""


class OperationMode(StrEnum):
    """Who or what decides the vehicle's motion."""

    PARKED = "parked"  # stands, holds still until START
    AUTONOMOUS = "autonomous"  # drives the trip by itself, waiting at lights included
    STOPPING = "stopping"  # comes to a comfortable stop, after STOP
    EMERGENCY = "emergency"  # brakes as hard as it can, after EMERGENCY_STOP


class ManoeuvreState(StrEnum):
    """How a manoeuvre is getting on."""

    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why the vehicle won't do something now.

    Attributes:
        code: The rationale.
        facts: The numbers and names that the sentence needs.
    """

    code: Rationale
    facts: Mapping[str, FactValue] = field(default_factory=dict)


@dataclass(slots=True)
class Manoeuvre:
    """A manoeuvre under way, which the vehicle updates and the executor watches.

    Attributes:
        kind: ``"turn"`` or ``"lane_change"``.
        state: How it is getting on.
        refusal: Why it failed, once it has.
        facts: What is worth telling about it.
    """

    kind: str
    state: ManoeuvreState = ManoeuvreState.RUNNING
    refusal: Refusal | None = None
    facts: dict[str, FactValue] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Binding:
    """The constraint that limits the vehicle's motion at this moment, from the planner's own trace.

    Attributes:
        constraint: Its name.
        facts: Numbers and names behind it (``{"leader_kmh": 34}``).
    """

    constraint: Constraint
    facts: Mapping[str, FactValue] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class SeenVehicle:
    """Another road user as perceived: where it is relative to ours.

    Attributes:
        position: ``ahead``, ``behind``, ``left`` or ``right``.
        distance_m: Straight-line distance between the centres.
        speed_mps: Its speed.
    """

    position: Literal["ahead", "behind", "left", "right"]
    distance_m: float
    speed_mps: float


@dataclass(frozen=True, slots=True)
class VehicleState:
    """What the vehicle knows of itself and its surroundings at one moment, as perceived, in SI.

    Attributes:
        time_s: Simulated time since the start.
        x_m: East.
        y_m: South (the map's y axis grows downwards, as on a screen).
        heading_rad: 0 is east, growing clockwise.
        speed_mps: Speed over ground.
        acceleration_mps2: Longitudinal acceleration.
        lateral_acceleration_mps2: Lateral acceleration, positive to the right.
        mode: Operation mode.
        road: Name of the street, or of the junction inside one.
        lane: Number of the lane from the left; None inside a junction.
        lanes: Number of lanes in this direction; None inside a junction.
        speed_limit_mps: Legal limit here, as perceived.
        lead_gap_m: Bumper-to-bumper gap to the vehicle ahead in the lane, None without one within sight.
        lead_speed_mps: Its speed.
        traffic_light: Perceived state of the next light, None without one within sight.
        traffic_light_distance_m: Distance to its stop line.
        destination: Goal of the trip.
        waypoints: Places to call at before it, in order.
        remaining_distance_m: Length of the remaining route, None without a route.
        eta_s: Estimated time to the goal from now, None without a route.
        next_manoeuvre: ``left``, ``right``, ``straight`` or ``arrive``; None without a route.
        next_manoeuvre_place: Name of the junction or place where it is due.
        next_manoeuvre_distance_m: Distance to it.
        indicator: Which indicator blinks.
        binding: The constraint that limits the motion.
        surroundings: Perceived road users near by, nearest first.
    """

    time_s: float
    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float
    acceleration_mps2: float
    lateral_acceleration_mps2: float
    mode: OperationMode
    road: str
    lane: int | None
    lanes: int | None
    speed_limit_mps: float
    lead_gap_m: float | None
    lead_speed_mps: float | None
    traffic_light: LightState | None
    traffic_light_distance_m: float | None
    destination: str | None
    waypoints: tuple[str, ...]
    remaining_distance_m: float | None
    eta_s: float | None
    next_manoeuvre: Literal["left", "right", "straight", "arrive"] | None
    next_manoeuvre_place: str | None
    next_manoeuvre_distance_m: float | None
    indicator: Side | None
    binding: Binding
    surroundings: tuple[SeenVehicle, ...]


class VehicleInterface(Protocol):
    """What a driving stack offers to the executor.

    Every ``request_…`` and ``override_…`` either takes effect and returns what can be watched, or changes nothing and
    returns a :class:`Refusal`.
    """

    @property
    def actions(self) -> frozenset[str]:
        """The actions of the language that this vehicle supports; the validator refuses every other one."""
        ...

    @property
    def places(self) -> tuple[str, ...]:
        """Names of the places on the loaded map."""
        ...

    def state(self) -> VehicleState:
        """The present state."""
        ...

    def status(self) -> VehicleStatus:
        """The present state as a translation is told it."""
        ...

    def settings(self) -> Mapping[str, FactValue]:
        """All driving parameters with their present values, in SI."""
        ...

    def set_destination(self, place: str) -> Refusal | None:
        """Plan a route to a place and make it the goal. Does not start a parked vehicle."""
        ...

    def start(self) -> Refusal | None:
        """Drive the trip by itself from now on. Refused during an emergency stop until the vehicle stands."""
        ...

    def stop(self) -> Refusal | None:
        """Brake comfortably in the lane, then hold. Keeps the route."""
        ...

    def emergency_stop(self) -> Refusal | None:
        """Brake as hard as possible, at once, then hold. Never refused."""
        ...

    def set_parameter(self, name: str, value: float | str) -> Refusal | None:
        """Set a driving parameter, in SI."""
        ...

    def request_turn(self, direction: TurnDirection) -> Manoeuvre | Refusal:
        """Take this way at the next junction instead of the route's, then lead on to the goal from there."""
        ...

    def request_lane_change(self, side: Side) -> Manoeuvre | Refusal:
        """Change one lane to this side as soon as it is safe."""
        ...

    def override_traffic_light(self, state: Literal["green", "red"]) -> Refusal | None:
        """Believe that the next light shows this colour, for this approach only."""
        ...

    def cancel(self, manoeuvre: Manoeuvre) -> None:
        """Call off a running manoeuvre where it can still be called off."""
        ...
