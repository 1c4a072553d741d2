"""Numbers in sentences: what is said is found again."""

from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wayword.models.training.augment.numbers import find_numbers, find_ordinals, say, say_ordinal

ALL_TENTHS = range(10_000)  # every number that `say` is for: below 1,000, with one decimal at most


def found(sentence: str) -> list[float]:
    return [mention.value for mention in find_numbers(sentence)]


@pytest.mark.parametrize("words", [True, False])
def test_every_number_is_found_where_it_was_said(words: bool) -> None:
    for tenths in ALL_TENTHS:
        said = say(tenths / 10, Random(tenths), words=words)
        (mention,) = find_numbers(f"Make it {said}, please.")
        assert mention.value == pytest.approx(tenths / 10), said
        assert (mention.start, mention.end) == (8, 8 + len(said)), said


@settings(deadline=None)
@given(
    tenths=st.lists(st.sampled_from(ALL_TENTHS), min_size=1, max_size=4),
    words=st.booleans(),
    upper=st.booleans(),
    joint=st.sampled_from([", ", " to ", " km/h, then ", " and not ", "? No, "]),
    rng=st.integers(0, 2**32).map(Random),
)
def test_several_numbers_are_found_in_their_order(
    tenths: list[int], words: bool, upper: bool, joint: str, rng: Random
) -> None:
    sentence = joint.join(say(number / 10, rng, words=words) for number in tenths)
    assert found(sentence.upper() if upper else sentence) == pytest.approx([number / 10 for number in tenths])


@pytest.mark.parametrize(
    ("sentence", "values"),
    [
        ("a hundred", [100]),
        ("hundred and ten", [110]),
        ("two hundred fifty", [250]),
        ("one seventy, not one seventeen", [170, 117]),
        ("Sixty-five", [65]),
        ("one and a half seconds", [1.5]),
        ("two point two five metres", [2.25]),
        ("60mph, 60 km/h, 60km/h", [60, 60, 60]),
        ("a 2.4-second gap", [2.4]),
        ("from fifty to 70.", [50, 70]),
    ],
)
def test_ways_to_say_a_number(sentence: str, values: list[float]) -> None:
    assert found(sentence) == values


@pytest.mark.parametrize(
    "sentence",
    [
        "",
        "no number",
        "someone phoned",
        "the seventeenth",
        "m/s2",
        "m/s^2",
        "version 1.2.3",
        "a forty-metre gap",
        "B27",
        "-5",
    ],
)
def test_what_is_no_number_of_its_own(sentence: str) -> None:
    assert found(sentence) == []


@given(st.integers(1, 5), st.integers(0, 2**32).map(Random))
def test_every_ordinal_is_found_where_it_was_said(value: int, rng: Random) -> None:
    said = say_ordinal(value, rng)
    (mention,) = find_ordinals(f"Take the {said} exit.")
    assert (mention.value, mention.start, mention.end, mention.ordinal) == (value, 9, 9 + len(said), True)


def test_seconds_are_no_ordinal() -> None:
    assert find_ordinals("two seconds, the sixth, 22nd") == []
