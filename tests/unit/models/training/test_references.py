"""Values by reference to the vehicle status."""

import re
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.programs import program
from tests.town import TOWN
from wayword.compiler import VehicleStatus, compile_program
from wayword.models.training.augment import scenes
from wayword.models.training.augment.numbers import find_numbers
from wayword.models.training.augment.references import CLARIFY_VALUE, evaluate, fill
from wayword.models.training.corpus import Corpus

TEMPLATES = Corpus(TOWN).reference_templates
VALUES = {"speed": 47.0, "limit": 50.0, "n": 10.0}
UNDER = program("SET_PARAM", max_vel="{limit-n} km/h")

numbers = st.integers(1, 99).map(lambda number: (str(number), float(number)))
known = st.sampled_from(list(VALUES.items()))
expressions = st.recursive(
    numbers | known,
    lambda inner: st.one_of(
        st.tuples(inner, inner).map(lambda p: (f"({p[0][0]}+{p[1][0]})", p[0][1] + p[1][1])),
        st.tuples(inner, inner).map(lambda p: (f"({p[0][0]}-{p[1][0]})", p[0][1] - p[1][1])),
        st.tuples(inner, numbers).map(lambda p: (f"({p[0][0]}*{p[1][0]})", p[0][1] * p[1][1])),
        st.tuples(inner, numbers).map(lambda p: (f"({p[0][0]}/{p[1][0]})", p[0][1] / p[1][1])),
    ),
    max_leaves=6,
)


@given(expressions)
def test_expressions_are_evaluated_as_written(expression: tuple[str, float]) -> None:
    text, value = expression
    assert evaluate(text, VALUES) == pytest.approx(value, abs=1e-6)


@pytest.mark.parametrize("text", ["__import__('os')", "speed.real", "-speed", "[1]", "speed**2", "'x'"])
def test_expressions_can_do_nothing_else(text: str) -> None:
    with pytest.raises((AssertionError, KeyError)):
        evaluate(text, VALUES)


@given(st.integers(31, 130), st.integers(0, 2**32).map(Random))
def test_the_value_is_the_one_that_the_sentence_refers_to(limit: int, rng: Random) -> None:
    filled = fill("{n} under the limit", UNDER, VehicleStatus(speed_limit_kmh=limit), rng)
    assert filled is not None
    (under,) = find_numbers(filled[0])
    assert filled[1] == program("SET_PARAM", max_vel=f"{limit - under.value:g} km/h")


def test_what_is_unknown_is_asked_for() -> None:
    unknown = VehicleStatus(speed_limit_kmh=None)
    filled = fill("{n} under the limit", UNDER, unknown, Random(0))
    assert filled is not None
    assert filled[1] == CLARIFY_VALUE == program("CLARIFY", about="value")
    assert fill("{n} under, and go", f"{UNDER}---\n{program('START')}", unknown, Random(0)) is None


def test_a_setting_at_its_default_is_no_unknown_value() -> None:
    slower = program("SET_PARAM", max_vel="{max_vel-n} km/h")
    assert fill("{n} less than set", slower, VehicleStatus(), Random(0)) is None
    assert fill("{n} less than set", slower, VehicleStatus(settings={"max_vel": "35 mph"}), Random(0)) is None
    assert fill("{n} less than set", slower, VehicleStatus(settings={"max_vel": "90 km/h"}), Random(0)) is not None


def test_no_value_without_sense() -> None:
    for seed in range(100):
        filled = fill("{n} under the limit", UNDER, VehicleStatus(speed_limit_kmh=20), Random(seed))
        assert filled is None or re.search(r"value: 1?\d km/h", filled[1])
    third = program("SET_PARAM", max_vel="{speed/3} km/h")
    assert fill("a third", third, VehicleStatus(speed_kmh=50), Random(0)) is None
    assert fill("a third", third, VehicleStatus(speed_kmh=60), Random(0)) is not None


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32).map(Random))
def test_every_template_becomes_a_program(rng: Random) -> None:
    for template in TEMPLATES:
        filled = fill(template.instruction, template.program, scenes.random_status(TOWN, rng), rng)
        if filled is None:
            continue
        said, source = filled
        assert "{" not in said + source
        result = compile_program(source, TOWN)
        assert {d.code.name for d in result.diagnostics} <= {"WW0303"}, source
        if result.ok:
            assert result.canonical == source


def test_every_template_can_be_filled() -> None:
    rng = Random(0)
    for template in TEMPLATES:
        filled = (
            fill(template.instruction, template.program, scenes.random_status(TOWN, rng), rng) for _ in range(100)
        )
        assert any(pair is not None and pair[1] != CLARIFY_VALUE for pair in filled), template.instruction
