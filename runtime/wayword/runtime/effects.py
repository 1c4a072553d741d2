"""What the executor does for each effect and how it sees that a condition holds.

An effect gives what the executor has to watch or report, or the vehicle's refusal.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import cast

from wayword.compiler import Do, Scalar
from wayword.runtime.answers import STANDING_MPS, answer, kmh
from wayword.runtime.vehicle import (
    FactValue,
    Manoeuvre,
    ManoeuvreState,
    OperationMode,
    Rationale,
    Refusal,
    Side,
    TurnDirection,
    VehicleInterface,
)


@dataclass(frozen=True, slots=True)
class Effect:
    """An effect that was accepted.

    Attributes:
        facts: What the report can tell about it.
        manoeuvre: The manoeuvre that it started, for ``AWAIT`` to watch.
    """

    facts: Mapping[str, FactValue] = field(default_factory=dict)
    manoeuvre: Manoeuvre | None = None


EffectHandler = Callable[[VehicleInterface, Do], Effect | Refusal]
Condition = Callable[[VehicleInterface, Manoeuvre | None], bool]


def _answer(vehicle: VehicleInterface, do: Do) -> Effect | Refusal:
    return Effect(answer(do.word("item"), vehicle.state(), vehicle.settings()))


def _set_destination(vehicle: VehicleInterface, do: Do) -> Effect | Refusal:
    place = do.word("place")
    under_way = vehicle.state().mode is OperationMode.AUTONOMOUS
    return vehicle.set_destination(place) or Effect({"destination": place, "variant": None if under_way else "halted"})


def _start(vehicle: VehicleInterface, _: Do) -> Effect | Refusal:
    return vehicle.start() or Effect({"destination": vehicle.state().destination})


def _stop(vehicle: VehicleInterface, _: Do) -> Effect | Refusal:
    destination = vehicle.state().destination
    return vehicle.stop() or Effect({"variant": "no_destination" if destination is None else None})


def _emergency_stop(vehicle: VehicleInterface, _: Do) -> Effect | Refusal:
    standing = vehicle.state().speed_mps < STANDING_MPS
    return vehicle.emergency_stop() or Effect({"variant": "standing" if standing else None})


def _set_parameter(vehicle: VehicleInterface, do: Do) -> Effect | Refusal:
    name, value = do.word("name"), do.operand("value")
    number = value.value if isinstance(value, Scalar) else str(value)
    refusal = vehicle.set_parameter(name, number)
    if refusal is not None:
        return refusal
    if name != "max_vel" or not isinstance(number, float):
        return Effect({"parameter": name, "value": str(value), "variant": "other"})
    limit = vehicle.state().speed_limit_mps
    above = kmh(number) > kmh(limit)  # as the passenger hears them
    facts: dict[str, FactValue] = {"max_vel_kmh": kmh(number), "limit_kmh": kmh(limit)}
    return Effect({**facts, "variant": "above_limit" if above else None})


def _turn(vehicle: VehicleInterface, do: Do) -> Effect | Refusal:
    direction = do.word("direction")
    variant = "straight" if direction == "straight" else None
    return _started(vehicle.request_turn(cast(TurnDirection, direction)), {"direction": direction, "variant": variant})


def _change_lane(vehicle: VehicleInterface, do: Do) -> Effect | Refusal:
    side = do.word("direction")
    return _started(vehicle.request_lane_change(cast(Side, side)), {"direction": side})


def _override_traffic_light(vehicle: VehicleInterface, do: Do) -> Effect | Refusal:
    state = do.word("state")
    refusal = vehicle.override_traffic_light("green" if state == "green" else "red")
    return refusal or Effect({"state": state})


def _reject(_: VehicleInterface, do: Do) -> Effect | Refusal:
    return Refusal(cast(Rationale, f"reject_{do.word('reason')}"))


def _ask(_: VehicleInterface, do: Do) -> Effect | Refusal:
    return Refusal(cast(Rationale, f"clarify_{do.word('about')}"))


def _started(manoeuvre: Manoeuvre | Refusal, facts: dict[str, FactValue]) -> Effect | Refusal:
    return Effect(facts, manoeuvre) if isinstance(manoeuvre, Manoeuvre) else manoeuvre


EFFECTS: dict[str, EffectHandler] = {
    "answer": _answer,
    "set_destination": _set_destination,
    "start": _start,
    "stop": _stop,
    "emergency_stop": _emergency_stop,
    "set_parameter": _set_parameter,
    "turn": _turn,
    "change_lane": _change_lane,
    "override_traffic_light": _override_traffic_light,
    "reject": _reject,
    "ask": _ask,
}


def _manoeuvre_done(_: VehicleInterface, manoeuvre: Manoeuvre | None) -> bool:
    return manoeuvre is not None and manoeuvre.state is ManoeuvreState.DONE


CONDITIONS: dict[str, Condition] = {
    "autonomous": lambda vehicle, _: vehicle.state().mode is OperationMode.AUTONOMOUS,
    "standstill": lambda vehicle, _: vehicle.state().mode is OperationMode.PARKED,
    "junction_passed": _manoeuvre_done,
    "lane_changed": _manoeuvre_done,
}
