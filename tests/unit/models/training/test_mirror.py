"""Left for right: the meaning turns with the words."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.programs import join, program
from tests.town import TOWN
from wayword.models.training.augment.mirror import mirror
from wayword.models.training.corpus import Corpus

sides = st.sampled_from(["left", "right"])
forms = st.sampled_from([str.lower, str.upper, str.capitalize])


def sides_of(text: str) -> list[str]:
    return re.findall(r"\b(?:left|right)\b", text.lower())


@given(st.lists(st.tuples(sides, forms), min_size=1, max_size=4))
def test_mirroring_twice_changes_nothing(said: list[tuple[str, object]]) -> None:
    words = [form(side) for side, form in said if callable(form)]
    sentence = f"Change to {', then '.join(f'the {word} lane' for word in words)}, please"
    source = join(*(program("CHANGE_LANE", direction=side) for side, _ in said))
    mirrored = mirror(sentence, source)
    assert mirrored is not None
    swapped = [{"left": "right", "right": "left"}[side] for side, _ in said]
    assert sides_of(mirrored[0]) == sides_of(mirrored[1]) == swapped
    assert mirror(*mirrored) == (sentence, source)


def test_mirroring_a_training_sentence_twice_changes_nothing() -> None:
    to_left, to_right = 0, 0
    for record in Corpus(TOWN).sentences:
        mirrored = mirror(record.instruction, record.program)
        if mirrored is not None:
            assert mirrored[0] != record.instruction
            assert mirrored[1] != record.program
            assert mirror(*mirrored) == (record.instruction, record.program)
            to_left += "left" in sides_of(mirrored[1])
            to_right += "right" in sides_of(mirrored[1])
    # Mirroring must not teach that one side is likelier than the other.
    assert min(to_left, to_right) > 200
    assert max(to_left, to_right) < 1.25 * min(to_left, to_right)


def test_case_stays() -> None:
    source = program("TURN", direction="left")
    assert mirror("Left by the church, the LEFT one, on the left", source) == (
        "Right by the church, the RIGHT one, on the right",
        program("TURN", direction="right"),
    )


@pytest.mark.parametrize(
    ("sentence", "source"),
    [
        ("Turn right now", program("TURN", direction="right")),
        ("All right, go right", program("TURN", direction="right")),
        ("Left at the church", program("TURN", direction="left")),  # "right at the church" may mean: just there
        ("That's it, right?", program("TURN", direction="right")),
        ("Pass him on the left, not on the right", program("OVERTAKE", side="left")),
        ("Overtake him", program("OVERTAKE")),
        ("How many minutes do we have left?", program("QUERY", item="eta")),
        ("To the port side", program("CHANGE_LANE", direction="left")),
        ("Prefer the bright lane", program("SET_PARAM", preferred_lane="right")),
    ],
)
def test_what_is_more_than_a_side_is_left_alone(sentence: str, source: str) -> None:
    assert mirror(sentence, source) is None
