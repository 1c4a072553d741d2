"""The safety monitor: it judges the ego by the true world, whatever the ego perceives."""

from wayword.runtime.world.ego import EgoCar
from wayword.runtime.world.network import LaneSegment
from wayword.runtime.world.roadway import TownRoad


class Monitor:
    """Counts what must not happen.

    Attributes:
        red_lights_run: Times that the ego's front bumper crossed a stop line at true red on its own account.
        red_lights_overridden: The same while the passenger had said that the light was green.
    """

    def __init__(self, road: TownRoad, ego: EgoCar) -> None:
        self.red_lights_run = 0
        self.red_lights_overridden = 0
        self._road = road
        self._ego = ego
        self._before = self._lane_before_line()

    @property
    def collisions(self) -> int:
        """Cars that the ego has hit or that have hit it."""
        return sum(self._ego in pair for pair in self._road.collisions)

    @property
    def collisions_of_others(self) -> int:
        """Collisions without the ego."""
        return len(self._road.collisions) - self.collisions

    def _lane_before_line(self) -> LaneSegment | None:
        """The lane whose stop line the ego's front bumper hasn't crossed yet."""
        segment = self._ego.segment
        return segment if segment.stop_line is not None and self._ego.front <= segment.stop_line else None

    def observe(self) -> None:
        """Look at the world after a time step."""
        before, self._before = self._before, self._lane_before_line()
        if before is None or self._before is not None:
            return
        scene, approach = self._ego.scene, before.link
        if scene.signals.state(approach, scene.time_s) != "red":
            return
        override = self._ego.perception.override_of(approach)
        if override is not None and override.state == "green":
            self.red_lights_overridden += 1
        else:
            self.red_lights_run += 1
