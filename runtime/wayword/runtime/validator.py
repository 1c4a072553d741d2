"""The explicit allow-list in front of the vehicle: what has no entry here is refused."""

from collections.abc import Callable

from wayword.compiler import LoweredCommand, Require
from wayword.runtime.effects import CONDITIONS, EFFECTS
from wayword.runtime.vehicle import OperationMode, Refusal, VehicleInterface

Predicate = Callable[[VehicleInterface, Require], Refusal | None]


def validate(vehicle: VehicleInterface, lowered: LoweredCommand) -> Refusal | None:
    """Whether the vehicle may start a command in its present state.

    Returns:
        None where it may, otherwise the rationale.
    """
    action = lowered.command.action.name
    if action not in vehicle.actions:
        return Refusal("not_supported", {"action": action})
    allowed = {"REQUIRE": PREDICATES.keys(), "DO": EFFECTS.keys(), "AWAIT": CONDITIONS.keys()}
    if any(instruction.name not in allowed[instruction.opcode] for instruction in lowered.instructions):
        if action in ("SET_PARAM", "ADJUST_PARAM"):
            return Refusal("unsupported_parameter", {"parameter": lowered.command.arguments[0].name})
        return Refusal("not_supported", {"action": action})
    for instruction in lowered.instructions:
        if isinstance(instruction, Require):
            refusal = PREDICATES[instruction.name](vehicle, instruction)
            if refusal is not None:
                return refusal
    return None


def _under_way(vehicle: VehicleInterface, _: Require) -> Refusal | None:
    return None if vehicle.state().mode is OperationMode.AUTONOMOUS else Refusal("not_under_way")


def _destination_known(vehicle: VehicleInterface, _: Require) -> Refusal | None:
    return None if vehicle.state().destination is not None else Refusal("no_destination")


def _place_reachable(vehicle: VehicleInterface, require: Require) -> Refusal | None:
    place = require.word("place")
    return None if place in vehicle.places else Refusal("unknown_place", {"place": place})


def _lane_exists(vehicle: VehicleInterface, require: Require) -> Refusal | None:
    state, direction = vehicle.state(), require.word("direction")
    if state.lane is None or state.lanes is None:
        return Refusal("too_close_to_junction")
    target = state.lane + (1 if direction == "right" else -1)
    return None if 1 <= target <= state.lanes else Refusal("no_such_lane", {"direction": direction})


def _traffic_light_seen(vehicle: VehicleInterface, require: Require) -> Refusal | None:
    if vehicle.state().traffic_light is not None:
        return None
    return Refusal("no_traffic_light", {"state": require.word("state")})


PREDICATES: dict[str, Predicate] = {
    "under_way": _under_way,
    "destination_known": _destination_known,
    "place_reachable": _place_reachable,
    "lane_exists": _lane_exists,
    "traffic_light_seen": _traffic_light_seen,
}
