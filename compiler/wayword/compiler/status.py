"""The vehicle status: what a translation is told about the vehicle, and what data files record of it."""

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class VehicleStatus(BaseModel):
    """The vehicle as its passenger sees it, null where unknown (language.md section 7).

    Attributes:
        speed_kmh: Present speed.
        speed_limit_kmh: Legal limit here, as the vehicle has read it.
        lane: Number of the lane, 1 being the leftmost of this direction.
        lanes: Number of lanes in this direction.
        lead_gap_m: Bumper-to-bumper gap to the vehicle ahead.
        traffic_light: What the vehicle sees of the next light.
        destination: The goal.
        waypoints: Places still to be called at on the way, in order.
        under_way: Whether the vehicle drives the trip by itself (also while it waits at a light).
        settings: Driving parameters that aren't at their default, as canonical text (``{"max_vel": "50 km/h"}``).
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    speed_kmh: float | None = Field(default=0.0, ge=0)
    speed_limit_kmh: float | None = Field(default=50.0, gt=0)
    lane: int | None = Field(default=1, ge=1)
    lanes: int | None = Field(default=2, ge=1)
    lead_gap_m: float | None = Field(default=None, ge=0)
    traffic_light: Literal["green", "yellow", "red"] | None = None
    destination: str | None = None
    waypoints: tuple[str, ...] = ()
    under_way: bool | None = False
    settings: dict[str, str] = Field(default_factory=dict)
