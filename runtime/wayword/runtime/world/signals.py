"""Traffic lights: at each junction one approach at a time has green, so that no two flows conflict."""

from collections.abc import Mapping
from dataclasses import dataclass

from wayword.runtime.vehicle import LightState
from wayword.runtime.world.maps import SignalTiming
from wayword.runtime.world.network import Junction, Link


@dataclass(frozen=True, slots=True)
class SignalController:
    """The lights of one junction, as a function of time.

    Attributes:
        junction: Where they stand.
        timing: Durations of the phases.
        offset_s: How far into its cycle the junction is at time 0.
    """

    junction: Junction
    timing: SignalTiming
    offset_s: float

    @property
    def cycle_s(self) -> float:
        """Time until everything repeats."""
        return self.timing.phase_s * len(self.junction.incoming)

    def _into_phase(self, approach: Link, time_s: float) -> float:
        """Time since the approach's green began, in [0, cycle)."""
        begin = self.timing.phase_s * self.junction.incoming.index(approach)
        return (time_s + self.offset_s - begin) % self.cycle_s

    def state(self, approach: Link, time_s: float) -> LightState:
        """What the light of an approach shows."""
        into = self._into_phase(approach, time_s)
        if into < self.timing.green_s:
            return "green"
        return "yellow" if into < self.timing.green_s + self.timing.yellow_s else "red"

    def remaining_s(self, approach: Link, time_s: float) -> float:
        """How long the present state of an approach still lasts."""
        into = self._into_phase(approach, time_s)
        ends = (self.timing.green_s, self.timing.green_s + self.timing.yellow_s, self.cycle_s)
        return next(end - into for end in ends if into < end)


class Signals:
    """All traffic lights of a town."""

    def __init__(self, controllers: Mapping[str, SignalController]) -> None:
        self._controllers = controllers

    def state(self, approach: Link, time_s: float) -> LightState:
        """What the light at the end of a link truly shows."""
        return self._controllers[approach.end.id].state(approach, time_s)

    def remaining_s(self, approach: Link, time_s: float) -> float:
        """How long it still does."""
        return self._controllers[approach.end.id].remaining_s(approach, time_s)
