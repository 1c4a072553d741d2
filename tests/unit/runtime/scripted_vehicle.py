"""A vehicle that does as the test says."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Literal

from wayword.compiler import VehicleStatus
from wayword.runtime.vehicle import (
    Binding,
    FactValue,
    Manoeuvre,
    ManoeuvreState,
    OperationMode,
    Refusal,
    SeenVehicle,
    Side,
    TurnDirection,
    VehicleState,
)

STATE = VehicleState(
    time_s=0.0,
    x_m=0.0,
    y_m=0.0,
    heading_rad=0.0,
    speed_mps=10.0,
    acceleration_mps2=0.0,
    lateral_acceleration_mps2=0.0,
    mode=OperationMode.AUTONOMOUS,
    road="Main Street",
    lane=1,
    lanes=2,
    speed_limit_mps=50 / 3.6,
    lead_gap_m=24.4,
    lead_speed_mps=34 / 3.6,
    traffic_light="red",
    traffic_light_distance_m=61.0,
    destination="Harbor",
    waypoints=(),
    remaining_distance_m=640.0,
    eta_s=95.0,
    next_manoeuvre="left",
    next_manoeuvre_place="Market Square",
    next_manoeuvre_distance_m=61.0,
    indicator=None,
    binding=Binding("leader", {"leader_kmh": 34}),
    surroundings=(SeenVehicle("ahead", 29.4, 9.4), SeenVehicle("right", 6.0, 9.0)),
)

SUPPORTED = frozenset(
    {"START", "STOP", "SET_DESTINATION", "QUERY", "SET_PARAM", "TURN", "CHANGE_LANE"}
    | {"OVERRIDE_TRAFFIC_LIGHT", "EMERGENCY_STOP", "REJECT", "CLARIFY"}
)


class ScriptedVehicle:
    """Records what is asked of it, and refuses what `refuses` names."""

    def __init__(self, **state: object) -> None:
        self.now = replace(STATE, **state)  # type: ignore[arg-type]
        self.calls: list[tuple[object, ...]] = []
        self.refuses: dict[str, Refusal] = {}
        self.manoeuvre: Manoeuvre | None = None
        self.cancelled: list[Manoeuvre] = []
        self.too_late_to_cancel = False

    def set(self, **state: object) -> None:
        self.now = replace(self.now, **state)  # type: ignore[arg-type]

    def wait(self, seconds: float) -> None:
        self.set(time_s=self.now.time_s + seconds)

    def _call(self, name: str, *arguments: object, **change: object) -> Refusal | None:
        if name in self.refuses:
            return self.refuses[name]
        self.set(**change)
        self.calls.append((name, *arguments))
        return None

    @property
    def actions(self) -> frozenset[str]:
        return SUPPORTED

    @property
    def places(self) -> tuple[str, ...]:
        return ("Harbor", "Home")

    def state(self) -> VehicleState:
        return self.now

    def status(self) -> VehicleStatus:
        return VehicleStatus()

    def settings(self) -> Mapping[str, FactValue]:
        return {"max_vel": 50 / 3.6, "following_distance": 1.8, "driving_style": "normal"}

    def set_destination(self, place: str) -> Refusal | None:
        return self._call("set_destination", place)

    def start(self) -> Refusal | None:
        return self._call("start", mode=OperationMode.AUTONOMOUS)

    def stop(self) -> Refusal | None:
        return self._call("stop", mode=OperationMode.STOPPING)

    def emergency_stop(self) -> Refusal | None:
        return self._call("emergency_stop", mode=OperationMode.EMERGENCY)

    def set_parameter(self, name: str, value: float | str) -> Refusal | None:
        return self._call("set_parameter", name, value)

    def _manoeuvre(self, kind: str, *arguments: object) -> Manoeuvre | Refusal:
        refusal = self._call(f"request_{kind}", *arguments)
        if refusal is not None:
            return refusal
        self.manoeuvre = Manoeuvre(kind)
        return self.manoeuvre

    def request_turn(self, direction: TurnDirection) -> Manoeuvre | Refusal:
        return self._manoeuvre("turn", direction)

    def request_lane_change(self, side: Side) -> Manoeuvre | Refusal:
        return self._manoeuvre("lane_change", side)

    def override_traffic_light(self, state: Literal["green", "red"]) -> Refusal | None:
        return self._call("override_traffic_light", state, traffic_light=state)

    def cancel(self, manoeuvre: Manoeuvre) -> None:
        self.cancelled.append(manoeuvre)
        if not self.too_late_to_cancel:
            manoeuvre.state = ManoeuvreState.FAILED
