"""Sentences moved to other maps."""

from functools import cache
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.programs import join, program
from tests.town import TOWN
from wayword.compiler import compile_program
from wayword.models.training.augment import places
from wayword.models.training.corpus import Corpus

CORPUS = Corpus(TOWN)
# Maps that share no word with the town, so that no name of it may be left.
STRANGE_NAMES = [name for name in CORPUS.place_names if places.is_free_of(TOWN, name)]
maps = st.lists(st.sampled_from(STRANGE_NAMES), min_size=3, max_size=14, unique=True)
goals = st.lists(st.sampled_from(TOWN), min_size=1, max_size=3, unique=True)


def trip(goals: list[str]) -> str:
    return join(*(program("ADD_WAYPOINT", waypoint=goal) for goal in goals))


@settings(deadline=None)
@given(goals=goals, new_map=maps, lower=st.booleans(), rng=st.integers(0, 2**32).map(Random))
def test_a_moved_sentence_names_places_of_the_new_map_in_the_order_of_its_program(
    goals: list[str], new_map: list[str], lower: bool, rng: Random
) -> None:
    sentence = f"Please call at {', then '.join(goals)}."
    sentence = sentence.lower() if lower else sentence
    source = trip(goals)
    assert places.is_movable(TOWN, sentence, source)
    said, moved = places.move(TOWN, new_map, sentence, source, rng)
    assert places.mentioned(TOWN, said) == places.in_program(TOWN, moved) == []
    chosen = places.in_program(new_map, moved)
    expected = f"{', then '.join(chosen)}."
    assert said.endswith(expected.lower() if lower else expected)
    assert len(chosen) == len(goals)
    assert compile_program(moved, new_map).ok


def test_no_training_sentence_keeps_a_name_of_its_old_map() -> None:
    rng = Random(0)
    moved = 0
    free = cache(lambda home: [name for name in STRANGE_NAMES if places.is_free_of(home, name)])
    for record in CORPUS.sentences:
        home = record.places or TOWN
        if not places.is_movable(home, record.instruction, record.program):
            continue
        new_map = rng.sample(free(home), 14)
        said, after = places.move(home, new_map, record.instruction, record.program, rng)
        assert not places.mentioned(home, said), said
        assert not places.in_program(home, after), after
        assert {d.code.name for d in compile_program(after, new_map).diagnostics} <= {"WW0303"}, after
        moved += said != record.instruction
    assert moved > 500


@pytest.mark.parametrize(
    ("sentence", "goals"),
    [
        ("To the station.", ["Main Station"]),  # half a name: another map has no station
        ("Home, yes, home.", ["Home"]),
        ("To the Library, not to the Museum.", ["Library"]),
        ("Somewhere nice.", ["Library"]),
        ("Past the Library.", []),
        ("To the Libraryship.", ["Library"]),
    ],
)
def test_what_cannot_be_moved(sentence: str, goals: list[str]) -> None:
    assert not places.is_movable(TOWN, sentence, trip(goals))


def test_a_sentence_without_places_can_be_moved_and_stays_as_it_is() -> None:
    source = program("SET_PARAM", max_vel="50 km/h")
    assert places.is_movable(TOWN, "Fifty.", source)
    assert places.move(TOWN, ("Zoo",), "Fifty.", source, Random(0)) == ("Fifty.", source)


def test_of_two_names_the_longer_one_is_meant() -> None:
    old = ("Gate", "North Gate")
    assert places.mentioned(old, "To the north gate.") == ["Gate", "North Gate"]
    assert not places.is_movable(old, "To the North Gate.", trip(["North Gate"]))


@pytest.mark.parametrize("sentence", ["To the Museum!", "to a museum!", "To my MUSEUM!", "To Museum!"])
def test_a_replaced_name_takes_its_article_with_it(sentence: str) -> None:
    assert places.replace_name("Museum", "Mars", sentence).lower() == "to mars!"


def test_free_of_names_means_of_all_their_words() -> None:
    assert not places.is_free_of(("Main Station",), "Which station is it?")
    assert places.is_free_of(("Main Station", "The Mill and Pond"), "The gas stations and so on")


@given(st.integers(0, 2**32).map(Random))
def test_invented_maps_have_three_to_fourteen_different_names(rng: Random) -> None:
    names = places.random_map(CORPUS.place_names, rng)
    assert 3 <= len(set(names)) == len(names) <= 14
    assert set(names) <= set(CORPUS.place_names)
