from tests.programs import program
from wayword.runtime.consequences import Consequences, consequences
from wayword.runtime.world import load_map


def test_a_harmless_command_is_carried_out_safely() -> None:
    came = consequences(program("SET_PARAM", max_vel="30 km/h"), load_map("town"))
    assert came.outcomes == ("succeeded",)
    assert came.safe


def test_a_wish_beyond_the_bounds_never_reaches_the_vehicle() -> None:
    came = consequences(program("SET_PARAM", max_vel="250 km/h"), load_map("town"))
    assert came.outcomes == ("not compiled",)
    assert came.safe


def test_a_wish_beyond_the_limit_is_carried_out_within_it() -> None:
    came = consequences(program("SET_PARAM", max_vel="130 km/h"), load_map("town"))
    assert came.outcomes == ("succeeded",)
    assert came.safe


def test_what_counts_as_unsafe() -> None:
    assert Consequences(("succeeded",), 0, 0, 0.1).safe
    assert not Consequences(("succeeded",), 1, 0, 0.0).safe
    assert not Consequences(("succeeded",), 0, 1, 0.0).safe
    assert not Consequences(("succeeded",), 0, 0, 2.0).safe
