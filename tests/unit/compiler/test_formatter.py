"""The canonical form, and when two programs are equal."""

import pytest
import yaml

from tests.programs import join, program
from wayword.compiler import compile_program, equivalent
from wayword.grammar import parser


def canonical(source: str) -> str:
    return compile_program(source).canonical


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        ("90.0", "90 km/h"),
        ("50.50 mph", "50.5 mph"),
        ("100", "100 km/h"),
        ("14.0 m/s", "14 m/s"),
    ],
)
def test_numbers_are_printed_without_needless_zeros_and_with_the_unit(written: str, printed: str) -> None:
    assert canonical(program("SET_PARAM", max_vel=written)) == program("SET_PARAM", max_vel=printed)


def test_deltas_keep_their_sign() -> None:
    assert canonical(program("ADJUST_PARAM", max_vel="+10.0")) == program("ADJUST_PARAM", max_vel="+10 km/h")


def test_parameters_are_printed_in_the_order_of_the_table() -> None:
    swapped = program("REPORT_OBJECT", distance="30 m", position="left")
    assert canonical(swapped) == program("REPORT_OBJECT", position="left", distance="30 m")


def test_canonical_form_is_a_fixed_point_and_in_the_canonical_grammar() -> None:
    source = join(program("SET_PARAM", max_vel="90"), program("TURN", direction="left"), program("STOP"))
    printed = canonical(source)
    assert canonical(printed) == printed
    parser("start").parse(printed)


def test_a_yaml_reader_loads_the_same_tree() -> None:
    source = join(program("SET_DESTINATION", destination="Main Station"), program("START"))
    assert list(yaml.safe_load_all(source)) == [
        {
            "command_type": "MISSION",
            "action": "SET_DESTINATION",
            "parameters": [{"name": "destination", "value": "Main Station"}],
        },
        {"command_type": "MISSION", "action": "START"},
    ]


@pytest.mark.parametrize(
    ("one", "other", "equal"),
    [
        (program("SET_PARAM", max_vel="90 km/h"), program("SET_PARAM", max_vel="25 m/s"), True),
        (program("SET_PARAM", max_vel="90 km/h"), program("SET_PARAM", max_vel="90.001 km/h"), False),
        (program("SET_PARAM", max_vel="90"), program("SET_PARAM", max_vel="90 km/h"), True),
        (
            program("SET_PARAM", following_distance="2 s"),
            program("SET_PARAM", following_distance="5 m"),
            False,
        ),
        (program("ADJUST_PARAM", max_vel="+10 km/h"), program("ADJUST_PARAM", max_vel="increase"), False),
        (program("TURN", direction="left"), program("TURN", direction="right"), False),
        (program("START"), join(program("START"), program("STOP")), False),
        (program("OVERTAKE"), program("OVERTAKE", side="left"), False),
    ],
)
def test_equality(one: str, other: str, equal: bool) -> None:
    first, second = compile_program(one).program, compile_program(other).program
    assert first is not None
    assert second is not None
    assert equivalent(first, second) is equal
