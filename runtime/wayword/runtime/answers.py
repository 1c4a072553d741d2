"""Answers to QUERY: facts from the vehicle's state and its planner's trace, never invented."""

from collections.abc import Callable, Mapping, Sequence

from wayword.runtime.vehicle import FactValue, SeenVehicle, VehicleState

Facts = dict[str, FactValue]
Settings = Mapping[str, FactValue]

STANDING_MPS = 0.3


def answer(item: str, state: VehicleState, settings: Settings) -> Facts:
    """The facts that answer a question.

    Args:
        item: What is asked for, one of the language's QUERY items.
        state: The vehicle's present state.
        settings: Its driving parameters in SI.

    Returns:
        The facts with ``item`` and, where the answer has several wordings, ``variant``.
    """
    return {"item": item, **_ANSWERS[item](state, settings)}


def kmh(mps: float) -> int:
    """Metres per second to whole kilometres per hour."""
    return round(mps * 3.6)


def spoken_distance(metres: float) -> str:
    """A distance as one says it: 40 m, 250 m, 1.2 km."""
    if metres >= 1000:
        return f"{metres / 1000:.1f} km"
    return f"{round(metres, -1):.0f} m" if metres >= 20 else f"{metres:.0f} m"


def spoken_duration(seconds: float) -> str:
    """A duration as one says it: 40 seconds, 1 minute, 12 minutes."""
    if seconds < 55:
        return f"{max(5, round(seconds / 5) * 5)} seconds"
    minutes = round(seconds / 60)
    return "1 minute" if minutes == 1 else f"{minutes} minutes"


def _speed(state: VehicleState, _: Settings) -> Facts:
    standing = state.speed_mps < STANDING_MPS
    return {"speed_kmh": kmh(state.speed_mps), "variant": "standing" if standing else None}


def _speed_limit(state: VehicleState, _: Settings) -> Facts:
    return {"limit_kmh": kmh(state.speed_limit_mps)}


def _destination(state: VehicleState, _: Settings) -> Facts:
    if state.destination is None:
        return {"variant": "none"}
    if state.waypoints:
        return {"destination": state.destination, "waypoints": listed(state.waypoints), "variant": "via"}
    return {"destination": state.destination}


def _eta(state: VehicleState, _: Settings) -> Facts:
    if state.eta_s is None:
        return {"variant": "none"}
    return {
        "destination": state.destination,
        "duration": spoken_duration(state.eta_s),
        "eta_s": round(state.eta_s, 1),
    }


def _remaining_distance(state: VehicleState, _: Settings) -> Facts:
    if state.remaining_distance_m is None:
        return {"variant": "none"}
    return {"destination": state.destination, "distance": spoken_distance(state.remaining_distance_m)}


def _position(state: VehicleState, _: Settings) -> Facts:
    return {"road": state.road}


def _lane(state: VehicleState, _: Settings) -> Facts:
    return {"lane": state.lane, "lanes": state.lanes, "variant": "junction" if state.lane is None else None}


def _lead_gap(state: VehicleState, _: Settings) -> Facts:
    if state.lead_gap_m is None:
        return {"variant": "none"}
    return {"gap_m": round(state.lead_gap_m), "leader_kmh": kmh(state.lead_speed_mps or 0.0)}


def _next_maneuver(state: VehicleState, _: Settings) -> Facts:
    if state.next_manoeuvre is None or state.next_manoeuvre_distance_m is None:
        return {"variant": "none"}
    return {
        "manoeuvre": state.next_manoeuvre,
        "place": state.next_manoeuvre_place,
        "distance": spoken_distance(state.next_manoeuvre_distance_m),
        "variant": "arrive" if state.next_manoeuvre == "arrive" else None,
    }


def _traffic_light(state: VehicleState, _: Settings) -> Facts:
    if state.traffic_light is None or state.traffic_light_distance_m is None:
        return {"variant": "none"}
    return {"light": state.traffic_light, "distance": spoken_distance(state.traffic_light_distance_m)}


def _operation_mode(state: VehicleState, _: Settings) -> Facts:
    return {"mode": state.mode.value}


def _settings(_: VehicleState, settings: Settings) -> Facts:
    return {"settings": listed([f"{name} {_spoken_setting(name, value)}" for name, value in settings.items()])}


def _surroundings(state: VehicleState, _: Settings) -> Facts:
    if not state.surroundings:
        return {"variant": "none"}
    nearest = state.surroundings[:4]
    count = len(state.surroundings)
    return {
        "count": "1 car" if count == 1 else f"{count} cars",
        "listed": listed([_spoken_vehicle(vehicle) for vehicle in nearest]),
    }


def _reason(state: VehicleState, _: Settings) -> Facts:
    rounded = {name: round(fact) if isinstance(fact, float) else fact for name, fact in state.binding.facts.items()}
    return {"constraint": state.binding.constraint, **rounded}


def _spoken_vehicle(vehicle: SeenVehicle) -> str:
    where = vehicle.position if vehicle.position in ("ahead", "behind") else f"on the {vehicle.position}"
    return f"one {where} at {vehicle.distance_m:.0f} m"


def _spoken_setting(name: str, value: FactValue) -> str:
    if isinstance(value, float):
        unit = {"max_vel": "km/h", "following_distance": "s", "min_gap": "m"}.get(name, "m/s^2")
        return f"{value * 3.6 if unit == 'km/h' else value:g} {unit}"
    return str(value)


def listed(items: Sequence[str]) -> str:
    """Several things as one says them: a, b and c."""
    return ", ".join(items[:-1]) + (" and " if len(items) > 1 else "") + items[-1] if items else ""


_ANSWERS: dict[str, Callable[[VehicleState, Settings], Facts]] = {
    "speed": _speed,
    "speed_limit": _speed_limit,
    "destination": _destination,
    "eta": _eta,
    "remaining_distance": _remaining_distance,
    "position": _position,
    "lane": _lane,
    "lead_gap": _lead_gap,
    "next_maneuver": _next_maneuver,
    "traffic_light": _traffic_light,
    "operation_mode": _operation_mode,
    "settings": _settings,
    "surroundings": _surroundings,
    "reason": _reason,
}
