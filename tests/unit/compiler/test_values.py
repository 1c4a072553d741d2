"""Units, defaults of units, and bounds at, just inside and just outside."""

import pytest

from tests.programs import program
from wayword.compiler import Compilation, Scalar, compile_program

STEP = 0.001  # the smallest difference that three decimals can express


def lowered_value(result: Compilation) -> float:
    (command,) = result.commands
    value = command.instructions[-1].operand("value")
    assert isinstance(value, Scalar)
    return value.value


def codes(source: str) -> list[str]:
    return [diagnostic.code.name for diagnostic in compile_program(source).diagnostics]


BOUNDS = [
    ("max_vel", 5, 130, "km/h"),
    ("following_distance", 1.0, 5.0, "s"),
    ("following_distance", 5, 150, "m"),
    ("min_gap", 1.5, 10, "m"),
    ("max_accel", 0.3, 3.0, "m/s^2"),
    ("max_decel", 1.0, 4.0, "m/s^2"),
    ("max_lat_accel", 0.5, 3.0, "m/s^2"),
]


@pytest.mark.parametrize(("name", "lower", "upper", "unit"), BOUNDS)
def test_bounds_of_driving_parameters(name: str, lower: float, upper: float, unit: str) -> None:
    for legal in (lower, lower + STEP, upper - STEP, upper):
        assert codes(program("SET_PARAM", **{name: f"{legal:.10g} {unit}"})) == []
    for illegal in (lower - STEP, upper + STEP):
        assert codes(program("SET_PARAM", **{name: f"{illegal:.10g} {unit}"})) == ["WW0303"]


@pytest.mark.parametrize(
    ("legal", "illegal"),
    [
        ("3.107 mph", "3.106 mph"),
        ("80.778 mph", "80.779 mph"),
        ("1.389 m/s", "1.388 m/s"),
        ("36.111 m/s", "36.112 m/s"),
    ],
)
def test_bounds_hold_in_every_unit(legal: str, illegal: str) -> None:
    assert codes(program("SET_PARAM", max_vel=legal)) == []
    assert codes(program("SET_PARAM", max_vel=illegal)) == ["WW0303"]


@pytest.mark.parametrize(
    ("action", "name", "lower", "upper", "unit", "others"),
    [
        ("OVERRIDE_SPEED_LIMIT", "limit", 5, 130, "km/h", {}),
        ("REPORT_OBJECT", "distance", 1, 200, "m", {"position": "ahead"}),
    ],
)
def test_bounds_of_action_parameters(
    action: str, name: str, lower: float, upper: float, unit: str, others: dict[str, str]
) -> None:
    for legal in (lower, lower + STEP, upper - STEP, upper):
        assert codes(program(action, **others, **{name: f"{legal:.10g} {unit}"})) == []
    for illegal in (lower - STEP, upper + STEP):
        assert codes(program(action, **others, **{name: f"{illegal:.10g} {unit}"})) == ["WW0303"]


@pytest.mark.parametrize(
    ("name", "written", "si"),
    [
        ("max_vel", "90 km/h", 25.0),
        ("max_vel", "90.0", 25.0),
        ("max_vel", "50 mph", 22.352),
        ("max_vel", "14 m/s", 14.0),
        ("following_distance", "2.5", 2.5),
        ("following_distance", "100 ft", 30.48),
        ("following_distance", "40 m", 40.0),
        ("min_gap", "10 ft", 3.048),
        ("min_gap", "3", 3.0),
        ("max_accel", "2", 2.0),
    ],
)
def test_units_become_si(name: str, written: str, si: float) -> None:
    assert lowered_value(compile_program(program("SET_PARAM", **{name: written}))) == pytest.approx(si, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("max_vel", "5 s"),
        ("max_vel", "20 m"),
        ("following_distance", "50 km/h"),
        ("min_gap", "2 s"),
        ("max_accel", "2 m/s"),
        ("max_decel", "2 m"),
        ("max_lat_accel", "2 s"),
    ],
)
def test_a_unit_of_another_dimension_is_a_type_error(name: str, written: str) -> None:
    assert codes(program("SET_PARAM", **{name: written})) == ["WW0301"]


@pytest.mark.parametrize(
    ("written", "code"),
    [
        ("50 kmh", "WW0302"),
        ("50 knots", "WW0302"),
        ("50km/h", "WW0305"),
        ("50  km/h", "WW0305"),
        ("fast", "WW0305"),
        ("12345 km/h", "WW0305"),
        ("50.1234 km/h", "WW0305"),
        ("5e1 km/h", "WW0305"),
        (".5 km/h", "WW0305"),
        ("090 km/h", "WW0305"),
        ("00.5 km/h", "WW0305"),
        ("٥٠ km/h", "WW0305"),
        ("+50 km/h", "WW0306"),
        ("-50 km/h", "WW0306"),
    ],
)
def test_malformed_numbers(written: str, code: str) -> None:
    assert codes(program("SET_PARAM", max_vel=written)) == [code]


@pytest.mark.parametrize("written", ["+10 km/h", "-0.5 km/h", "increase", "decrease", "+10"])
def test_deltas(written: str) -> None:
    assert codes(program("ADJUST_PARAM", max_vel=written)) == []


def test_a_delta_needs_a_sign_and_has_no_bounds() -> None:
    assert codes(program("ADJUST_PARAM", max_vel="10 km/h")) == ["WW0306"]
    assert codes(program("ADJUST_PARAM", max_vel="-900 km/h")) == []


@pytest.mark.parametrize("name", ["driving_style", "preferred_lane", "lane_changes"])
def test_words_cannot_be_adjusted(name: str) -> None:
    assert codes(program("ADJUST_PARAM", **{name: "increase"})) == ["WW0307"]
