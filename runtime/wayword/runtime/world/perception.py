"""What the ego's sensors tell it, apart from what is true, and what the passenger told it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from wayword.runtime.vehicle import LightState
from wayword.runtime.world.network import Link
from wayword.runtime.world.scene import Scene

OVERRIDE_S = 30.0
"""An override is forgotten after this time."""


@dataclass(frozen=True, slots=True)
class Fault:
    """A fault of the perception.

    Attributes:
        kind: ``misread_light``: the lights of a junction are seen in one state, whatever they show.
        junction: Identifier of the junction.
        state: What is seen.
    """

    kind: Literal["misread_light"]
    junction: str
    state: LightState


@dataclass(frozen=True, slots=True)
class LightOverride:
    """What the passenger said about one light.

    Attributes:
        approach: The link whose light it is.
        state: What it is said to show.
        until_s: When it is forgotten.
    """

    approach: Link
    state: Literal["green", "red"]
    until_s: float


class Perception:
    """The lights as the ego sees them."""

    def __init__(self, scene: Scene, faults: Sequence[Fault] = ()) -> None:
        self._scene = scene
        self._misread = {fault.junction: fault.state for fault in faults}
        self._override: LightOverride | None = None

    def light(self, approach: Link) -> LightState:
        """What the light at the end of a link seems to show."""
        override = self.override_of(approach)
        if override is not None:
            return override.state
        misread = self._misread.get(approach.end.id)
        return misread if misread is not None else self._scene.signals.state(approach, self._scene.time_s)

    def override_of(self, approach: Link) -> LightOverride | None:
        """What the passenger said about this light, if it still counts."""
        override = self._override
        if override is None or override.approach is not approach:
            return None
        return override if self._scene.time_s < override.until_s else None

    def override(self, approach: Link, state: Literal["green", "red"]) -> None:
        """Believe the passenger about this light, for this approach and for a while."""
        self._override = LightOverride(approach, state, self._scene.time_s + OVERRIDE_S)

    def passed(self, approach: Link) -> None:
        """The light has been passed: what was said about it no longer counts."""
        if self._override is not None and self._override.approach is approach:
            self._override = None
