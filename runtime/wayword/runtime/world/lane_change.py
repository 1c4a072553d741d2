"""Lane changes: wait for a gap, blink, make sure again, move over."""

from typing import TYPE_CHECKING, Literal

from wayword.runtime.vehicle import FactValue, Manoeuvre, ManoeuvreState, OperationMode, Rationale, Refusal, Side
from wayword.runtime.world.lateral import LANE_CHANGE_S, SHORTEST_LANE_CHANGE_M
from wayword.runtime.world.longitudinal import lane_change_gap, rss_distance
from wayword.runtime.world.network import LaneSegment

if TYPE_CHECKING:
    from wayword.runtime.world.car import Car

INDICATE_S = 3.0
"""The indicator blinks at least this long before the lateral motion (UN R79)."""
PATIENCE_S = 20.0
"""How long a gap is waited for."""
_LEAST_GAP_M = 3.0
_CUT_IN_SHARE = 0.6
"""Share of the time gap that must be there at once; the rest opens up while following."""
_LOOK_BACK_M = 80.0
_MARGIN_M = 5.0
_LEAST_SPEED_MPS = 1.0

Purpose = Literal["request", "route", "pass"]


def length_needed(car: "Car", indicating: float) -> float:
    """Way that blinking for `indicating` more seconds and moving over takes at the present speed, in m."""
    moving = max(SHORTEST_LANE_CHANGE_M, LANE_CHANGE_S * car.speed)
    return indicating * car.speed + moving + _MARGIN_M


def room_ahead(car: "Car") -> float:
    """From the front bumper to the end of the lane, in m."""
    end = car.segment.stop_line if car.segment.stop_line is not None else car.segment.length
    return end - car.front


class LaneChange:
    """One lane change of one car, from the wish to the end.

    Attributes:
        side: Where it goes.
        purpose: The passenger's ``request``, the ``route``, or to ``pass`` a parked car.
        manoeuvre: What the executor watches.
        moving: Whether the lateral motion has begun.
    """

    def __init__(self, car: "Car", side: Side, purpose: Purpose) -> None:
        self.side: Side = side
        self.purpose = purpose
        self.manoeuvre = Manoeuvre("lane_change", facts={"side": side})
        self.moving = False
        self._since_s = car.scene.time_s

    def step(self, car: "Car") -> None:
        """Take the next step of the lane change."""
        if self.moving:
            if car.shift is None:
                self._end(car, ManoeuvreState.DONE)
            return
        target = car.segment.neighbour(self.side)
        waited = car.scene.time_s - self._since_s
        if target is None or room_ahead(car) < length_needed(car, 0.0):
            self._end(car, ManoeuvreState.FAILED, "too_close_to_junction")
        elif self.purpose == "request" and waited > PATIENCE_S:
            self._end(car, ManoeuvreState.FAILED, "no_gap")
        elif waited >= INDICATE_S and self._may_start(car, target):
            self.moving = True
            car.shift_to(target, self.side)

    def call_off(self, car: "Car", code: Rationale) -> None:
        """Give it up, unless the car is moving over already."""
        if not self.moving:
            self._end(car, ManoeuvreState.FAILED, code)

    def _end(self, car: "Car", state: ManoeuvreState, code: Rationale | None = None) -> None:
        self.manoeuvre.state = state
        if code is not None:
            facts: dict[str, FactValue] = {"side": self.side}
            self.manoeuvre.refusal = Refusal(code, facts)
        car.lane_change = None

    def _may_start(self, car: "Car", target: LaneSegment) -> bool:
        if car.speed < _LEAST_SPEED_MPS and not _parked_ahead(car):
            return False
        return _can_move_over(car) and gap_is_safe(car, target)


def _parked_ahead(car: "Car") -> bool:
    leader = car.planner.leader
    return leader is not None and leader.car.mode is OperationMode.PARKED


def _can_move_over(car: "Car") -> bool:
    """Whether the car ahead leaves room to drive out sideways, even if it brakes to a stop."""
    leader = car.planner.leader
    if leader is None:
        return True
    stops_in = leader.car.speed**2 / (2 * car.parameters.max_decel)
    return leader.gap + stops_in > max(SHORTEST_LANE_CHANGE_M + 1.0, 2.0 * car.speed)


def gap_is_safe(car: "Car", target: LaneSegment) -> bool:
    """UN R79's gap to the car behind in the target lane, RSS's to the car ahead."""
    occupancy = car.scene.occupancy
    ahead = occupancy.leader(car, [target], car.s, _LOOK_BACK_M)
    if ahead is not None:
        settled = car.parameters.min_gap + _CUT_IN_SHARE * car.parameters.time_gap * car.speed
        needed = max(_LEAST_GAP_M, settled, rss_distance(car.speed, ahead.car.speed))
        if ahead.gap < needed:
            return False
    behind = occupancy.follower(car, target, car.s, _LOOK_BACK_M)
    if behind is None:
        return True
    return behind.gap >= max(_LEAST_GAP_M, lane_change_gap(car.speed, behind.car.speed))
