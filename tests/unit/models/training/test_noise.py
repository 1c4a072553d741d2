"""Noise changes how something is said, not what."""

import re
from collections import Counter
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.town import TOWN
from wayword.models.training.augment import noise
from wayword.models.training.augment.numbers import find_numbers, say
from wayword.models.training.corpus import Corpus

SENTENCES = [record.instruction for record in Corpus(TOWN).sentences]
sentences = st.sampled_from(SENTENCES)
rngs = st.integers(0, 2**32).map(Random)


def numbers(sentence: str) -> Counter[float]:
    return Counter(mention.value for mention in find_numbers(sentence))


@settings(max_examples=300, deadline=None)
@given(sentences, rngs)
def test_a_recogniser_writes_no_capitals_and_no_punctuation(sentence: str, rng: Random) -> None:
    heard = noise.as_heard(sentence, rng)
    assert heard == heard.lower()
    assert not re.search(r"[,;:!?\"“”]|\.(?!\d)|^\s|\s$|\s\s", heard) or not re.search(r"\w", sentence)


@given(st.integers(1, 9999), st.sampled_from(["Drive {}!", "{}km/h", "Gap: {} m, OK?", "{}."]), rngs)
def test_a_recogniser_keeps_numbers(tenths: int, template: str, rng: Random) -> None:
    sentence = template.format(say(tenths / 10, rng, words=False))
    assert numbers(noise.as_heard(sentence, rng)) == pytest.approx(numbers(sentence)) == {tenths / 10: 1}


def test_no_number_of_a_training_sentence_gets_lost() -> None:
    rng = Random(0)
    lost = 0
    for sentence in SENTENCES:
        heard = noise.as_heard(sentence, rng)
        assert not numbers(heard) - numbers(noise.mishear(heard, rng)), heard
        lost += bool(numbers(sentence) - numbers(heard))
    # Without the full stop between them, "end of sixty. One hundred" runs together, as it does for a recogniser.
    assert lost < len(SENTENCES) / 1000


@settings(deadline=None)
@given(sentences, rngs)
def test_one_word_at_most_is_misheard(sentence: str, rng: Random) -> None:
    before, after = sentence.split(" "), noise.mishear(sentence, rng).split(" ")
    same_start = next((i for i, (a, b) in enumerate(zip(before, after, strict=False)) if a != b), len(before))
    rest = len(before) - same_start - 1
    assert before == after or before[same_start + 1 :] == after[len(after) - rest :]


def test_a_misheard_word_makes_no_other_number() -> None:
    heard = {noise.mishear("drop to sixty", Random(seed)) for seed in range(100)}
    assert heard == {"drop to sixty", "drop too sixty"}


@settings(deadline=None)
@given(sentences, rngs)
def test_a_slip_of_the_finger_stays_inside_a_word(sentence: str, rng: Random) -> None:
    typed = noise.mistype(sentence, rng)
    assert len(typed.split(" ")) == len(sentence.split(" "))
    assert abs(len(typed) - len(sentence)) <= 1
    changed = Counter(typed)
    changed.subtract(Counter(sentence))
    assert sum(map(abs, changed.values())) <= 1


@settings(max_examples=300, deadline=None)
@given(sentences, rngs)
def test_courtesy_leaves_the_sentence_whole(sentence: str, rng: Random) -> None:
    polite = noise.add_courtesy(sentence, rng)
    assert sentence[1:].rstrip(".!?") in polite
    assert len(polite) > len(sentence)


def test_courtesy_behind_a_sentence_names_no_side_and_no_number() -> None:
    """ "Overtake him right" would ask for a side."""
    for seed in range(2000):
        _, _, behind = noise.add_courtesy("Overtake him.", Random(seed)).partition("him")
        assert not re.search(r"\b(left|right)\b", behind)
        assert not find_numbers(behind)


@pytest.mark.parametrize("sentence", ["", "?!", "…"])
def test_what_has_no_words_is_survived(sentence: str) -> None:
    for seed in range(50):
        rng = Random(seed)
        assert noise.as_heard(sentence, rng) == sentence
        assert noise.mishear(sentence, rng) == sentence
        assert noise.mistype(sentence, rng) == sentence
