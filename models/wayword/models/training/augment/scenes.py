"""Vehicle statuses as they occur on the road, at random."""

from collections.abc import Sequence
from random import Random

from wayword.compiler import VehicleStatus

_LIMITS = (20, 30, 30, 40, 50, 50, 50, 60, 70, 80, 80, 90, 100, 100, 110, 120, 120, 130)


def random_status(places: Sequence[str], rng: Random) -> VehicleStatus:
    """A plausible status on the map with these places."""
    limit = rng.choice(_LIMITS) if rng.random() < 0.92 else None
    under_way = rng.random() < 0.75
    lanes = rng.choice((1, 2, 2, 2, 3, 3, 4))
    goals = rng.sample(list(places), min(len(places), 3))
    has_goal = rng.random() < (0.9 if under_way else 0.4)
    return VehicleStatus(
        speed_kmh=_speed(limit or 60, rng) if under_way else 0.0,
        speed_limit_kmh=limit,
        lane=rng.randint(1, lanes),
        lanes=lanes,
        lead_gap_m=rng.randint(5, 90) if rng.random() < 0.45 else None,
        traffic_light=rng.choice(("green", "yellow", "red")) if rng.random() < 0.3 else None,
        destination=goals[0] if has_goal else None,
        waypoints=tuple(goals[1 : rng.choice((1, 1, 1, 2, 3))]) if has_goal else (),
        under_way=under_way,
        settings=_settings(rng) if rng.random() < 0.35 else {},
    )


def _speed(limit: int, rng: Random) -> float | None:
    if rng.random() < 0.05:
        return None
    if rng.random() < 0.2:
        return float(rng.randint(0, limit))
    return float(rng.choice((limit, limit - rng.randint(1, 12), rng.randint(limit // 2, limit))))


def _settings(rng: Random) -> dict[str, str]:
    options = {
        "max_vel": f"{rng.choice((30, 50, 60, 70, 80, 90, 100, 110, rng.randint(20, 125)))} km/h",
        "following_distance": f"{rng.randint(10, 40) / 10:g} s",
        "min_gap": f"{rng.randint(3, 12) / 2:g} m",
        "max_accel": f"{rng.randint(5, 30) / 10:g} m/s^2",
        "max_decel": f"{rng.randint(10, 40) / 10:g} m/s^2",
        "max_lat_accel": f"{rng.randint(5, 30) / 10:g} m/s^2",
        "driving_style": rng.choice(("calm", "sporty")),
        "preferred_lane": rng.choice(("left", "right")),
        "lane_changes": rng.choice(("avoid", "eager")),
    }
    return {name: options[name] for name in rng.sample(sorted(options), rng.choice((1, 1, 1, 2, 3)))}
