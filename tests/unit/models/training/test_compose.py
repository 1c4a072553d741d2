"""Two instructions in one sentence."""

from itertools import pairwise
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.programs import join as programs
from tests.programs import program
from tests.town import TOWN
from wayword.compiler import compile_program
from wayword.models.training.augment.compose import can_be_part, join
from wayword.models.training.corpus import Corpus

PARTS = [
    (record.instruction, record.program)
    for record in Corpus(TOWN).sentences
    if record.places is None and can_be_part(record.instruction, record.program)
]
parts = st.sampled_from(PARTS)


@settings(deadline=None)
@given(parts, parts, st.integers(0, 2**32).map(Random))
def test_both_instructions_are_there_in_their_order(one: tuple[str, str], two: tuple[str, str], rng: Random) -> None:
    joined = join(one, two, rng)
    if joined is None:
        return
    said, source = joined
    assert source == programs(one[1], two[1])
    assert said.startswith(one[0].rstrip(" .!"))
    assert said.lower().endswith(two[0].lower())
    assert len(said) > len(one[0].rstrip(" .!")) + len(two[0])
    assert {d.code.name for d in compile_program(source, TOWN).diagnostics} <= {"WW0303"}


def test_nearly_all_pairs_can_be_joined() -> None:
    shuffled = Random(0).sample(PARTS, len(PARTS))
    joined = [join(one, two, Random(0)) for one, two in pairwise(shuffled)]
    assert sum(pair is not None for pair in joined) > 0.7 * len(joined)


def test_one_wish_is_not_joined_with_itself_or_its_contrary() -> None:
    fifty, sixty = (("Drive it", program("SET_PARAM", max_vel=f"{speed} km/h")) for speed in (50, 60))
    left, right = (("Change lanes", program("CHANGE_LANE", direction=side)) for side in ("left", "right"))
    assert join(fifty, sixty, Random(0)) is None
    assert join(left, right, Random(0)) is None
    assert join(fifty, left, Random(0)) is not None


def test_only_the_beginning_of_the_second_instruction_loses_its_capital() -> None:
    one, two = ("Go left!", program("TURN", direction="left")), ("Drive to City Hall.", program("KEEP_LANE"))
    ends = {said for seed in range(100) if (said := (join(one, two, Random(seed)) or ("",))[0])}
    assert "Go left and drive to City Hall." in ends
    assert "Go left. Drive to City Hall." in ends
    assert all(said.endswith("rive to City Hall.") for said in ends)
    name = ("BMW ahead, overtake", program("OVERTAKE"))
    assert all("BMW" in (join(one, name, Random(seed)) or ("",))[0] for seed in range(20))


@pytest.mark.parametrize(
    ("sentence", "source"),
    [
        ("Stop right there", program("EMERGENCY_STOP")),
        ("Take me somewhere", program("CLARIFY", about="destination")),
        ("Run the light", program("REJECT", reason="unsafe")),
        ("How old is Bob", program("REJECT", reason="unrelated")),
        ("To Mars", program("REJECT", reason="unknown_place")),
        ("Let's drive", program("START")),
        ("Go left, then right", program("TURN", direction="left")),
        ("No, the left lane", program("CHANGE_LANE", direction="left")),
        ("How fast are we?", program("QUERY", item="speed")),
        ("Left lane", programs(program("KEEP_LANE"), program("KEEP_LANE"))),
        ("Change to the lane on the left " * 2, program("CHANGE_LANE", direction="left")),
    ],
)
def test_what_needs_a_sentence_of_its_own(sentence: str, source: str) -> None:
    assert not can_be_part(sentence, source)
