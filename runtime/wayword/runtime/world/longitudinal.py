"""Car-following and braking laws: pure functions on floats, all in SI.

Sources:
    Treiber and Kesting, Traffic Flow Dynamics (2013), section 11.3: the improved intelligent driver model (IIDM),
    the constant-acceleration heuristic (CAH), and the ACC model that combines the two.
    Shalev-Shwartz, Shammah and Shashua, On a Formal Model of Safe and Scalable Self-driving Cars (2017),
    definition 1: RSS longitudinal distance.
    UN Regulation No. 79, revision 4, paragraph 5.6.4.7: critical situation at the start of a lane change.
"""

import math

FREE_EXPONENT = 4.0
SLOWING_S = 1.0
"""Time constant with which a speed above the wanted one decays."""
BRAKING_BUILD_UP_S = 0.3
"""Time that passes at full speed, in effect, before comfortable braking has built up."""
COOLNESS = 0.99
HARD_BRAKING = 8.0
"""What tyres and brakes give on a dry road, in m/s²."""

RSS_RESPONSE_S = 0.75
RSS_ACCEL = 3.0
RSS_BRAKE = 6.0

R79_RESPONSE_S = 0.4
R79_BRAKE = 3.0
R79_TIME_GAP_S = 1.0

_PROFILE_GAIN = 1.0
_PROFILE_SHARE = 0.8
_STOP_TOLERANCE_M = 0.3


def free_acceleration(speed: float, wanted: float, accel: float, decel: float) -> float:
    """Towards the speed `wanted`: the IIDM's free term up to it, above it braking no harder than `decel`.

    The IIDM's own braking term takes very long for the last few km/h, so that a passenger would think that a lower
    maximum had not been understood: here the excess decays with a time constant once comfortable braking is enough.
    """
    if speed <= wanted:
        return accel * (1.0 - float((speed / max(wanted, 0.1)) ** FREE_EXPONENT))
    return max(-decel, (wanted - speed) / SLOWING_S)


def follow_acceleration(free: float, ratio: float, accel: float) -> float:
    """IIDM interaction term.

    Args:
        free: The free acceleration.
        ratio: Desired gap over present gap.
        accel: Maximum acceleration.
    """
    if ratio >= 1.0:
        interaction = accel * (1.0 - ratio * ratio)
        return interaction if free >= 0.0 else free + interaction
    if free <= 1e-6:
        return free
    return float(free * (1.0 - ratio ** (2.0 * accel / free)))


def heuristic_acceleration(speed: float, leader_speed: float, leader_accel: float, gap: float, accel: float) -> float:
    """CAH: the braking that just avoids a crash if the leader keeps its acceleration."""
    leader_accel = min(leader_accel, accel)
    if leader_speed * (speed - leader_speed) < -2.0 * gap * leader_accel:  # it stops before we reach it
        return speed * speed * leader_accel / (leader_speed * leader_speed - 2.0 * gap * leader_accel)
    closing = max(0.0, speed - leader_speed)
    return leader_accel - closing * closing / (2.0 * gap)


def cool_acceleration(following: float, heuristic: float, decel: float) -> float:
    """ACC model: don't panic where the IIDM does but the situation isn't dangerous, as after a car has cut in."""
    if following >= heuristic:
        return following
    calm = heuristic + decel * math.tanh((following - heuristic) / decel)
    return (1.0 - COOLNESS) * following + COOLNESS * calm


def rss_distance(rear_speed: float, front_speed: float) -> float:
    """Gap from which the rear car can still stop behind the front one, braking at the hard floor of both."""
    after_response = rear_speed + RSS_RESPONSE_S * RSS_ACCEL
    return max(
        0.0,
        rear_speed * RSS_RESPONSE_S
        + 0.5 * RSS_ACCEL * RSS_RESPONSE_S**2
        + after_response**2 / (2 * RSS_BRAKE)
        - front_speed**2 / (2 * RSS_BRAKE),
    )


def desired_gap(
    speed: float, leader_speed: float, min_gap: float, time_gap: float, accel: float, decel: float
) -> float:
    """Gap wanted to a leader: the setting or RSS, whichever is more, and the IDM's share for closing in."""
    steady = max(min_gap + time_gap * speed, rss_distance(speed, leader_speed))
    closing = speed * (speed - leader_speed) / (2.0 * math.sqrt(accel * decel))
    return steady + max(0.0, closing)


def lane_change_gap(speed: float, rear_speed: float) -> float:
    """Gap that a car coming up from behind in the target lane needs (UN R79): dv·0.4 + dv²/(2·3) + v·1.0."""
    closing = max(0.0, rear_speed - speed)
    return R79_RESPONSE_S * closing + closing**2 / (2 * R79_BRAKE) + R79_TIME_GAP_S * speed


def required_deceleration(speed: float, target: float, distance: float) -> float:
    """Constant braking that reaches `target` speed within `distance`; infinite where there is none left."""
    if speed <= target:
        return 0.0
    return (speed * speed - target * target) / (2.0 * distance) if distance > 0.0 else math.inf


def stopping_distance(speed: float, decel: float) -> float:
    """Way to a standstill at constant braking, with some for the braking to build up under the jerk limit, in m."""
    return speed * speed / (2.0 * decel) + BRAKING_BUILD_UP_S * speed


def approach_acceleration(speed: float, target: float, distance: float, decel: float) -> float:
    """Follow the speed profile √(target² + 2·β·distance), which reaches `target` by braking constantly with β.

    β is a little below the comfortable deceleration. Feeding β forward and correcting the deviation in proportion
    makes the braking set in smoothly as the profile comes near, and brings a car that creeps gently to its stop.
    """
    share = _PROFILE_SHARE * decel
    if distance <= 0.0:
        return max(-decel, _PROFILE_GAIN * (target - speed))
    profile = math.sqrt(target * target + 2.0 * share * distance)
    return max(-decel, _PROFILE_GAIN * (profile - speed) - share)


def stop_acceleration(speed: float, distance: float, decel: float) -> float:
    """Come to a stop within `distance`: comfortably where that is enough, else as hard as is needed."""
    if distance <= -_STOP_TOLERANCE_M:
        return -HARD_BRAKING if speed > 0.0 else 0.0
    required = required_deceleration(speed, 0.0, distance + _STOP_TOLERANCE_M)
    smooth = approach_acceleration(speed, 0.0, distance, decel)
    return max(-HARD_BRAKING, min(smooth, -required) if required > _PROFILE_SHARE * decel else smooth)
