"""A car of the town: highway-env's bicycle kinematics under our own driving stack."""

import math
from typing import TYPE_CHECKING, Protocol

from highway_env.vehicle.kinematics import Vehicle

from wayword.runtime.vehicle import LightState, OperationMode, Side
from wayword.runtime.world.demand import Demand
from wayword.runtime.world.lateral import (
    AXLE_M,
    LENGTH_M,
    LaneShift,
    PathView,
    path_curvature,
    steering_for,
)
from wayword.runtime.world.longitudinal import HARD_BRAKING, required_deceleration
from wayword.runtime.world.network import LaneSegment, Link
from wayword.runtime.world.parameters import DriverParameters
from wayword.runtime.world.planner import Planner, curve_speed
from wayword.runtime.world.scene import Scene

if TYPE_CHECKING:
    from wayword.runtime.world.lane_change import LaneChange
    from wayword.runtime.world.roadway import TownRoad

SIGHT_M = 120.0
"""How far beyond the present segment the path is planned."""
TIME_STEP_S = 1 / 15
MAX_JERK = 3.0
"""Comfortable change of the acceleration, in m/s³."""
_STANDSTILL_MPS = 0.05
_TURN_SIGNAL_M = 45.0
_BRAKING_DELAY_S = 0.7
"""Time that a comfortable jerk takes to build up the braking, roughly."""


class Navigator(Protocol):
    """Who decides where a car goes."""

    def onward(self, car: "Car", lane: LaneSegment) -> LaneSegment | None:
        """The connector to take at the end of a lane; None where the trip ends on that lane."""
        ...

    def entered(self, car: "Car", segment: LaneSegment) -> None:
        """The car's rear axle has come on to a segment."""
        ...


class Car(Vehicle):  # type: ignore[misc]  # highway-env has no types
    """A car that follows lanes.

    Attributes:
        scene: The world around it.
        parameters: How it is driven.
        navigator: Where it goes.
        mode: Operation mode.
        segment: The lane or connector that its rear axle is on.
        s: Where the rear axle is along it, in m.
        offset: Lateral offset of the rear axle from its centre, in m.
        path: The segments ahead, the present one first.
        shift: Its lane change in motion.
        lane_change: The lane change it is about to make or is making.
        indicator: Which indicator blinks.
        acceleration: In m/s².
        curvature: Of the path it steers, in 1/m.
        demand: The planner's latest decision.
    """

    heading: float
    speed: float

    def __init__(
        self,
        road: "TownRoad",
        scene: Scene,
        lane: LaneSegment,
        s: float,
        speed: float,
        parameters: DriverParameters,
        navigator: Navigator,
    ) -> None:
        """Place a car with its rear axle at `s` metres along a lane."""
        heading = lane.curve.heading_at(s)
        super().__init__(road, lane.curve.point(s + AXLE_M), heading, speed)
        self.scene = scene
        self.parameters = parameters
        self.navigator = navigator
        self.mode = OperationMode.AUTONOMOUS
        self.segment = lane
        self.s, self.offset = s, 0.0
        self.path = [lane]
        self.shift: LaneShift | None = None
        self.lane_change: LaneChange | None = None
        self.indicator: Side | None = None
        self.acceleration = self.curvature = 0.0
        self.demand = Demand(0.0, "free_road", {})
        self.planner = Planner()
        self._previous: LaneSegment | None = None
        self.replan()

    @property
    def front(self) -> float:
        """Where the front bumper is along the path, from the start of the present segment, in m."""
        return self.s + LENGTH_M

    @property
    def anticipated_speed(self) -> float:
        """Speed in m/s once the present acceleration has been taken back with a comfortable jerk."""
        return self.speed + max(0.0, self.acceleration) ** 2 / (2 * MAX_JERK)

    def sees(self, approach: Link) -> LightState:
        """What the light at the end of a link shows to this driver."""
        return self.scene.signals.state(approach, self.scene.time_s)

    def relies_on_passenger(self, approach: Link) -> bool:  # noqa: ARG002 - the ego's does
        """Whether the driver takes a light for green only because a passenger says so."""
        return False

    def distance_to_goal(self) -> float | None:
        """From the car's centre to where its trip ends, in m; None where that isn't on the path."""
        return None

    def connector_entered(self) -> LaneSegment | None:
        """The connector that some part of the car is on; it counts as entered from the stop line on.

        So two cars that pass their lines one right after the other see each other in time.
        """
        if self.segment.kind == "connector":
            return self.segment
        return self.path[1] if len(self.path) > 1 and self.front > self._last_point else None

    def replan(self) -> None:
        """Plan the path anew from the present segment, keeping the next connector where it is too late for another."""
        kept = self.path[1] if len(self.path) > 1 and self.path[1] in self.segment.connectors.values() else None
        path = [self.segment]
        if kept is not None and self._committed_to(kept):
            path.append(kept)
        reach = sum(segment.length for segment in path[1:])
        while reach < SIGHT_M:
            last = path[-1]
            onward = last.exit if last.kind == "connector" else self.navigator.onward(self, last)
            if onward is None:
                break
            path.append(onward)
            reach += onward.length
        self.path = path

    def _committed_to(self, connector: LaneSegment) -> bool:
        if self.front > self._last_point:
            return True
        other = self.navigator.onward(self, self.segment)
        return other is not None and other is not connector and not self.can_take(other)

    @property
    def _last_point(self) -> float:
        """Where the present lane is left: at its stop line, or where there is none at its end."""
        line = self.segment.stop_line
        return line if line is not None else self.segment.length

    def can_take(self, connector: LaneSegment) -> bool:
        """Whether braking comfortably makes the car slow enough for a connector of this lane."""
        target = curve_speed(connector, self.parameters.max_lat_accel)
        distance = self.segment.length - self.s - _BRAKING_DELAY_S * self.speed
        return required_deceleration(self.speed, target, distance) <= self.parameters.max_decel

    def act(self, action: object = None) -> None:  # noqa: ARG002 - highway-env's signature
        """Decide steering and acceleration for the next time step."""
        if self.lane_change is not None:
            self.lane_change.step(self)
        if self._plans_now():
            self.demand = self.planner.plan(self)
        self.acceleration = self._smoothed(self.demand)
        self._steer()
        self._blink()
        self.action = {"steering": steering_for(self.curvature), "acceleration": self.acceleration}

    def _plans_now(self) -> bool:
        return True

    def _smoothed(self, demand: Demand) -> float:
        """Limit the jerk, and never roll backwards."""
        now, wanted = self.acceleration, demand.acceleration
        if self.speed < _STANDSTILL_MPS and wanted <= 0.0:
            return -self.speed / TIME_STEP_S
        if not demand.urgent:
            wanted = max(wanted, now - MAX_JERK * TIME_STEP_S)
        wanted = min(wanted, max(now, -self.parameters.max_decel) + MAX_JERK * TIME_STEP_S)
        return max(wanted, -HARD_BRAKING, -self.speed / TIME_STEP_S)

    def _steer(self) -> None:
        if self.shift is not None:
            self.shift.advance(self.speed, TIME_STEP_S)
            if self.shift.progress >= 1.0:
                self.shift = None
        following = self.path[1] if len(self.path) > 1 else None
        view = PathView(self._previous, self.segment, following, self.s)
        self.curvature = path_curvature(view, self.heading, self.offset, self.speed, self.shift)

    def _blink(self) -> None:
        if self.lane_change is not None:
            self.indicator = self.lane_change.side
            return
        connector = self.segment if self.segment.kind == "connector" else None
        if connector is None and len(self.path) > 1 and self.segment.length - self.front < _TURN_SIGNAL_M:
            connector = self.path[1]
        turning = connector is not None and connector.movement != "straight" and connector.junction.signalised
        self.indicator = None
        if turning and connector is not None:
            self.indicator = "left" if connector.movement == "left" else "right"

    def shift_to(self, lane: LaneSegment, side: Side) -> None:
        """Begin the lateral motion to a neighbouring lane."""
        origin, self.segment = self.segment, lane
        self.s, self.offset = lane.curve.project(*self._rear_axle())
        self.shift = LaneShift(side, origin, self.offset)
        self._previous = None
        self.replan()

    def _rear_axle(self) -> tuple[float, float]:
        return (
            float(self.position[0]) - AXLE_M * math.cos(self.heading),
            float(self.position[1]) - AXLE_M * math.sin(self.heading),
        )

    def on_state_update(self) -> None:
        """Follow the rear axle along the path; highway-env's search over all lanes is far too slow."""
        self.heading = float(self.heading)
        self.speed = float(self.speed) if abs(self.speed) > 1e-9 else 0.0  # what rounding leaves of a stop
        x, y = self._rear_axle()
        self.s, self.offset = self.segment.curve.project(x, y)
        while self.s > self.segment.length and len(self.path) > 1:
            self._previous = self.path.pop(0)
            self.segment = self.path[0]
            self.s, self.offset = self.segment.curve.project(x, y)
            self.lane_index = self.segment.index
            self.lane = self.road.network.get_lane(self.lane_index)
            self.navigator.entered(self, self.segment)
            self.replan()
