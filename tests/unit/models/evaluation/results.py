"""Makes results of evaluations for tests."""

from wayword.models.evaluation.translation import Result


def result(
    got: str = "",
    *,
    confidence: float = 0.99,
    correct: bool = False,
    tags: tuple[str, ...] = (),
    category: str = "OUT_OF_SCOPE",
    instruction: str = "Hello.",
) -> Result:
    return Result(
        id="r1",
        instruction=instruction,
        category=category,
        tags=tags,
        expected="",
        got=got,
        correct=correct,
        parsed=True,
        confidence=confidence,
        latency_ms=100.0,
        tokens=10,
    )
