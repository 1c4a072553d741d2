"""The passenger's car: the town's implementation of the vehicle interface."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal

from wayword.compiler.status import VehicleStatus
from wayword.compiler.vocabulary import DRIVING_PARAMETERS, Measure
from wayword.runtime.vehicle import (
    FactValue,
    LightState,
    Manoeuvre,
    OperationMode,
    Refusal,
    Side,
    TurnDirection,
    VehicleState,
)
from wayword.runtime.world import requests, right_of_way
from wayword.runtime.world.car import Car
from wayword.runtime.world.demand import Demand
from wayword.runtime.world.lane_change import INDICATE_S, LaneChange, length_needed, room_ahead
from wayword.runtime.world.lateral import AXLE_M
from wayword.runtime.world.longitudinal import stopping_distance
from wayword.runtime.world.network import LaneSegment, Link
from wayword.runtime.world.parameters import DriverParameters
from wayword.runtime.world.perception import Perception
from wayword.runtime.world.report import light_ahead, status_of, vehicle_state
from wayword.runtime.world.scene import Scene
from wayword.runtime.world.trip import TripNavigator

if TYPE_CHECKING:
    from wayword.runtime.world.roadway import TownRoad

ARRIVED_M = 3.0
"""A car that stands this near to its goal has arrived."""
_LAST_CHANCE_S = 9.0

ACTIONS = frozenset(
    {
        "START",
        "STOP",
        "SET_DESTINATION",
        "QUERY",
        "SET_PARAM",
        "TURN",
        "CHANGE_LANE",
        "OVERRIDE_TRAFFIC_LIGHT",
        "EMERGENCY_STOP",
        "REJECT",
        "CLARIFY",
    }
)


class EgoCar(Car):
    """The automated car that the passenger talks to; implements ``VehicleInterface``.

    Attributes:
        perception: What its sensors tell.
        trip: Its navigation.
    """

    def __init__(
        self,
        road: "TownRoad",
        scene: Scene,
        lane: LaneSegment,
        s: float,
        perception: Perception,
    ) -> None:
        """Place the car, parked, with its rear axle at `s` metres along a lane."""
        self.perception = perception
        self.trip = TripNavigator(scene.network, scene.timing)
        self._kept_lane_on: Link | None = None
        super().__init__(road, scene, lane, s, 0.0, DriverParameters(), self.trip)
        self.mode = OperationMode.PARKED
        self.demand = Demand(0.0, "parked", {})

    # --- driving -------------------------------------------------------------------------------------------------

    def sees(self, approach: Link) -> LightState:
        """What the light at the end of a link seems to show."""
        return self.perception.light(approach)

    def relies_on_passenger(self, approach: Link) -> bool:
        """Whether the car takes a light for green only because the passenger says so."""
        override = self.perception.override_of(approach)
        return override is not None and override.state == "green"

    def act(self, action: object = None) -> None:
        """Decide, and keep the operation mode up to date."""
        if self.speed == 0.0 and self._comes_to_rest():
            self.mode = OperationMode.PARKED
        if self.mode is OperationMode.AUTONOMOUS and self.lane_change is None and self.shift is None:
            self._follow_route_lanes()
        super().act(action)

    def _comes_to_rest(self) -> bool:
        if self.mode in (OperationMode.STOPPING, OperationMode.EMERGENCY):
            return True
        return self.mode is OperationMode.AUTONOMOUS and self.has_arrived()

    def has_arrived(self) -> bool:
        """Whether the car is at its goal."""
        distance = self.distance_to_goal()
        return distance is not None and distance < ARRIVED_M

    def distance_to_goal(self) -> float | None:
        """From the car's centre to its goal along the path, in m; None where that isn't on the path."""
        goal = self.trip.goal
        if goal is None or not self.trip.ends_on(goal.link, self.segment.link):
            return None
        start = -self.s - AXLE_M
        for segment in self.path:
            if segment.kind == "road" and segment.link is goal.link:
                return start + goal.s
            start += segment.length
        return None

    def _follow_route_lanes(self) -> None:
        """Change to a lane from which the route goes on; after the passenger's own change as late as possible."""
        if self.segment.kind != "road":
            return
        wanted = self.trip.lanes_for(self.segment.link)
        if not wanted or self.segment in wanted:
            return
        room = self._room_for_lane_change()
        if room < length_needed(self, INDICATE_S):
            return
        if self._kept_lane_on is self.segment.link and room > 30.0 + _LAST_CHANCE_S * self.speed:
            return
        side: Side = "left" if wanted[0].lane < self.segment.lane else "right"
        self.lane_change = LaneChange(self, side, "route")

    def keep_lane_on(self, link: Link) -> None:
        """The passenger chose the lane on this link: leave it no earlier than the route needs."""
        self._kept_lane_on = link

    def _room_for_lane_change(self) -> float:
        goal = self.distance_to_goal()
        room = room_ahead(self)
        return room if goal is None else min(room, goal)

    def on_state_update(self) -> None:
        """Follow the path; forget what was said about a light that has been passed."""
        before = self.segment
        super().on_state_update()
        if self.segment is not before and self.segment.kind == "connector":
            self.perception.passed(self.segment.link)

    # --- VehicleInterface ----------------------------------------------------------------------------------------

    @property
    def actions(self) -> frozenset[str]:
        """The actions of the language that this vehicle supports."""
        return ACTIONS

    @property
    def places(self) -> tuple[str, ...]:
        """Names of the places on the map."""
        return tuple(self.scene.network.places)

    def state(self) -> VehicleState:
        """The present state."""
        return vehicle_state(self)

    def status(self) -> VehicleStatus:
        """The present state as a translation is told it."""
        return status_of(self)

    def settings(self) -> Mapping[str, FactValue]:
        """All driving parameters with their present values, in SI."""
        defaults: dict[str, FactValue] = {
            name: parameter.default.si if isinstance(parameter.default, Measure) else parameter.default
            for name, parameter in DRIVING_PARAMETERS.items()
        }
        return defaults | {"max_vel": self.parameters.max_vel}

    def set_destination(self, place: str) -> Refusal | None:
        """Plan a route to a place and make it the goal."""
        goal = self.scene.network.places.get(place)
        if goal is None:
            return Refusal("unknown_place", {"place": place})
        self.trip.set_goal(goal)
        self.recheck_goal()
        return None

    def recheck_goal(self) -> None:
        """Plan anew, past a goal on the present link that lies behind or is too near to stop there comfortably."""
        goal = self.trip.goal
        self.trip.goes_round = False
        if goal is not None and self.segment.kind == "road" and self.segment.link is goal.link:
            braking = stopping_distance(self.speed, self.parameters.max_decel)
            self.trip.goes_round = goal.s - self.s - AXLE_M < braking - ARRIVED_M
        self.replan()

    def start(self) -> Refusal | None:
        """Drive the trip from now on."""
        if self.mode is OperationMode.EMERGENCY:
            return Refusal("emergency_braking")
        if self.trip.goal is None:
            return Refusal("no_destination")
        if self.mode is OperationMode.PARKED and self.has_arrived():
            return Refusal("already_there", {"destination": self.trip.goal.name})
        self.mode = OperationMode.AUTONOMOUS
        return None

    def stop(self) -> Refusal | None:
        """Brake comfortably in the lane, then hold."""
        if self.mode is OperationMode.AUTONOMOUS:
            self.mode = OperationMode.STOPPING
            self.planner.stop_rule = right_of_way.StopRule()
            self._call_off_lane_change()
        return None

    def emergency_stop(self) -> Refusal | None:
        """Brake as hard as possible, then hold."""
        if self.mode is not OperationMode.PARKED:
            self.mode = OperationMode.EMERGENCY
            self._call_off_lane_change()
        return None

    def _call_off_lane_change(self) -> None:
        if self.lane_change is not None:
            self.lane_change.call_off(self, "cancelled")

    def set_parameter(self, name: str, value: float | str) -> Refusal | None:
        """Set a driving parameter, in SI."""
        if name != "max_vel" or isinstance(value, str):
            return Refusal("unsupported_parameter", {"parameter": name})
        self.parameters = self.parameters.with_max_vel(float(value))
        return None

    def request_turn(self, direction: TurnDirection) -> Manoeuvre | Refusal:
        """Take this way at the next junction, then lead on to the goal from there."""
        return requests.turn(self, direction)

    def request_lane_change(self, side: Side) -> Manoeuvre | Refusal:
        """Change one lane to this side as soon as it is safe."""
        return requests.lane_change(self, side)

    def override_traffic_light(self, state: Literal["green", "red"]) -> Refusal | None:
        """Believe that the next light shows this colour, for this approach only."""
        line = light_ahead(self)
        if line is None:
            return Refusal("no_traffic_light")
        self.perception.override(line.approach, state)
        return None

    def cancel(self, manoeuvre: Manoeuvre) -> None:
        """Call off a running manoeuvre where it can still be called off."""
        requests.cancel(self, manoeuvre)
