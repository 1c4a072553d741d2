"""The laws of risk–coverage curves."""

from itertools import pairwise
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.unit.models.evaluation.results import result
from wayword.models.evaluation.selective import choose_threshold, risk_coverage
from wayword.models.evaluation.translation import Result

CONFIDENCES = st.floats(0, 1) | st.sampled_from([0.0, 0.5, 1.0])
RESULTS = st.lists(
    st.builds(lambda confidence, correct: result(confidence=confidence, correct=correct), CONFIDENCES, st.booleans()),
    min_size=1,
    max_size=40,
)
COVERAGES = st.floats(0.01, 1)


def error_rate(results: list[Result]) -> float:
    return sum(not one.correct for one in results) / len(results)


@given(RESULTS)
def test_coverage_rises_to_all_and_confidence_falls(results: list[Result]) -> None:
    curve = risk_coverage(results)
    assert len(curve.coverage) == len(curve.risk) == len(curve.confidence) == len(results)
    assert all(one < other for one, other in pairwise(curve.coverage))
    assert all(one >= other for one, other in pairwise(curve.confidence))
    assert curve.coverage[-1] == 1.0


@given(RESULTS)
def test_the_risk_at_full_coverage_is_the_error_rate(results: list[Result]) -> None:
    curve = risk_coverage(results)
    assert curve.risk[-1] == pytest.approx(error_rate(results))
    assert curve.accuracy_at(1.0) == pytest.approx(1 - error_rate(results))


@given(RESULTS)
def test_risks_and_their_area_are_shares(results: list[Result]) -> None:
    curve = risk_coverage(results)
    assert np.all((curve.risk >= 0) & (curve.risk <= 1))
    assert 0 <= curve.area <= 1


@given(st.lists(st.booleans(), min_size=1, max_size=40), st.randoms(use_true_random=False))
def test_a_perfect_ranking_has_the_least_area_and_the_contrary_the_greatest(
    outcomes: list[bool], random: Random
) -> None:
    def area(ranked: list[bool]) -> float:
        return risk_coverage([result(confidence=1 / (i + 1), correct=c) for i, c in enumerate(ranked)]).area

    shuffled = list(outcomes)
    random.shuffle(shuffled)
    best, worst = area(sorted(outcomes, reverse=True)), area(sorted(outcomes))
    assert best - 1e-12 <= area(shuffled) <= worst + 1e-12


@given(RESULTS, COVERAGES)
def test_the_accuracy_at_a_coverage_is_that_of_the_surest(results: list[Result], coverage: float) -> None:
    surest = sorted(results, key=lambda one: -one.confidence)
    count = next(n for n in range(1, len(results) + 1) if n / len(results) >= coverage - 1e-12)
    assert risk_coverage(results).accuracy_at(coverage) == pytest.approx(1 - error_rate(surest[:count]))


@given(RESULTS, COVERAGES)
def test_the_threshold_keeps_at_least_the_coverage_asked_for(results: list[Result], coverage: float) -> None:
    threshold = choose_threshold(results, least_coverage=coverage)
    acted_on = sum(one.confidence >= threshold for one in results)
    assert acted_on / len(results) >= coverage - 1e-12
    assert 0 <= threshold <= 1


@given(st.lists(st.booleans(), min_size=1, max_size=30), COVERAGES)
def test_no_other_threshold_is_less_risky(outcomes: list[bool], coverage: float) -> None:
    results = [result(confidence=(i + 1) / 100, correct=correct) for i, correct in enumerate(outcomes)]

    def risk(threshold: float) -> float:
        return error_rate([one for one in results if one.confidence >= threshold])

    chosen = risk(choose_threshold(results, least_coverage=coverage))
    for one in results:
        if sum(other.confidence >= one.confidence for other in results) >= coverage * len(results):
            assert chosen <= risk(one.confidence) + 1e-12


def test_a_threshold_parts_the_right_from_the_wrong() -> None:
    results = [result(confidence=c, correct=True) for c in (0.9, 0.8, 0.7)]
    wrong = result(confidence=0.3, correct=False)
    assert choose_threshold([wrong, *results], least_coverage=0.75) == pytest.approx(0.5)
    assert choose_threshold([wrong, *results], least_coverage=0.95) == pytest.approx(0.15)
    assert choose_threshold(results) == pytest.approx(0.35)
    assert choose_threshold(results, least_coverage=0.3) == pytest.approx(0.35), "no risk less, so the most coverage"


def test_known_values() -> None:
    curve = risk_coverage(
        [result(confidence=c, correct=right) for c, right in ((0.2, False), (0.9, True), (0.5, True), (0.7, False))]
    )
    assert curve.risk.tolist() == pytest.approx([0, 1 / 2, 1 / 3, 1 / 2])
    assert curve.area == pytest.approx((0 + 1 / 2 + 1 / 3 + 1 / 2) / 4)
    assert curve.accuracy_at(0.75) == pytest.approx(2 / 3)


def test_there_is_no_curve_of_nothing() -> None:
    with pytest.raises(ValueError, match="no results"):
        risk_coverage([])
