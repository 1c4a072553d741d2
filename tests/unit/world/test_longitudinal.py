"""Car-following and braking laws."""

import pytest

from wayword.runtime.world import longitudinal as law


def test_the_free_term_is_zero_at_the_wanted_speed_and_bounded_above_it() -> None:
    assert law.free_acceleration(0.0, 13.9, 1.5, 2.0) == 1.5
    assert law.free_acceleration(13.9, 13.9, 1.5, 2.0) == pytest.approx(0.0)
    assert -2.0 <= law.free_acceleration(36.0, 1.4, 1.5, 2.0) < -1.9


def test_the_wanted_gap_is_the_equilibrium_of_following() -> None:
    free = law.free_acceleration(10.0, 20.0, 1.5, 2.0)
    assert law.follow_acceleration(free, 1.0, 1.5) == pytest.approx(0.0)
    assert law.follow_acceleration(free, 1.2, 1.5) < 0.0 < law.follow_acceleration(free, 0.8, 1.5)


def test_rss_distance_by_hand() -> None:
    # 15·0.75 + 3·0.75²/2 + (15 + 2.25)²/12 - 10²/12
    assert law.rss_distance(15.0, 10.0) == pytest.approx(11.25 + 0.84375 + 24.796875 - 8.3333333)
    assert law.rss_distance(5.0, 40.0) == 0.0


def test_the_gap_held_is_never_below_rss() -> None:
    assert law.desired_gap(20.0, 0.0, 2.0, 0.1, 1.5, 2.0) >= law.rss_distance(20.0, 0.0)


def test_lane_change_gap_of_un_r79_by_hand() -> None:
    # 20 km/h faster from behind: dv·0.4 + dv²/(2·3) + v·1.0
    assert law.lane_change_gap(10.0, 16.0) == pytest.approx(6 * 0.4 + 36 / 6 + 10)
    assert law.lane_change_gap(10.0, 5.0) == pytest.approx(10.0)


def test_a_cut_in_of_a_faster_car_is_no_panic() -> None:
    following = law.follow_acceleration(1.0, 3.0, 1.5)
    heuristic = law.heuristic_acceleration(10.0, 12.0, 0.0, 8.0, 1.5)
    assert following < -8.0
    assert law.cool_acceleration(following, heuristic, 2.0) > -2.5


def test_a_standing_obstacle_is_still_braked_for() -> None:
    heuristic = law.heuristic_acceleration(10.0, 0.0, 0.0, 10.0, 1.5)
    assert heuristic == pytest.approx(-5.0)
    assert law.cool_acceleration(-20.0, heuristic, 2.0) < -5.0


@pytest.mark.parametrize(("speed", "distance"), [(14.0, 100.0), (8.0, 40.0), (3.0, 6.0)])
def test_stopping_is_comfortable_and_exact(speed: float, distance: float) -> None:
    dt, hardest = 1 / 15, 0.0
    while speed > 0.01 and distance > -1.0:
        acceleration = min(1.5, law.stop_acceleration(speed, distance, 2.0))
        hardest = min(hardest, acceleration)
        speed = max(0.0, speed + acceleration * dt)
        distance -= speed * dt
    assert hardest >= -2.2
    assert distance == pytest.approx(0.0, abs=0.3)
