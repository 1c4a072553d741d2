"""Selective prediction: how wrong the model is on those instructions that it is surest of."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wayword.models.evaluation.translation import Result


@dataclass(frozen=True, slots=True)
class RiskCoverage:
    """A risk–coverage curve.

    Attributes:
        coverage: Share of the instructions that are acted on, the surest first, shape (n,), ascending.
        risk: Share of errors among these, shape (n,).
        confidence: The least confidence among these, shape (n,), descending.
    """

    coverage: NDArray[np.float64]
    risk: NDArray[np.float64]
    confidence: NDArray[np.float64]

    @property
    def area(self) -> float:
        """Area under the curve (AURC): the mean risk over all coverages (Geifman and El-Yaniv, NeurIPS 2017)."""
        return float(self.risk.mean())

    def accuracy_at(self, coverage: float) -> float:
        """Share of right programs among the surest instructions that make up at least this share of all."""
        index = int(np.searchsorted(self.coverage, coverage - 1e-12))
        return 1.0 - float(self.risk[index])


def risk_coverage(results: Sequence[Result]) -> RiskCoverage:
    """The curve of an evaluation.

    Raises:
        ValueError: There are no results.
    """
    if not results:
        raise ValueError("no results to draw a risk–coverage curve of")
    ordered = sorted(results, key=lambda result: -result.confidence)
    wrong = np.array([not result.correct for result in ordered], dtype=float)
    count = np.arange(1, len(ordered) + 1)
    return RiskCoverage(
        coverage=count / len(ordered),
        risk=np.cumsum(wrong) / count,
        confidence=np.array([result.confidence for result in ordered]),
    )


def choose_threshold(results: Sequence[Result], *, least_coverage: float = 0.95) -> float:
    """The threshold below which to ask back: the one of least risk that still acts on enough instructions.

    Args:
        results: On development data.
        least_coverage: Share of the instructions that must be acted on.

    Returns:
        A confidence, 0 to 1, midway between the least sure instruction acted on and the next one.
    """
    curve = risk_coverage(results)
    allowed = np.flatnonzero(curve.coverage >= least_coverage - 1e-12)
    best = int(allowed[np.flatnonzero(curve.risk[allowed] == curve.risk[allowed].min())[-1]])
    below = curve.confidence[best + 1] if best + 1 < len(curve.confidence) else 0.0
    return float((curve.confidence[best] + below) / 2)
