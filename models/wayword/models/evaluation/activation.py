"""False activation: speech that is not meant for the vehicle and yet becomes a command."""

from collections.abc import Sequence
from typing import Any

from wayword.models.confidence import ASK_BACK_BELOW, run_of
from wayword.models.evaluation.judgement import Effect, effect
from wayword.models.evaluation.translation import Result, latency


def activation_summary(results: Sequence[Result], threshold: float = ASK_BACK_BELOW) -> dict[str, Any]:
    """The figures of an evaluation on speech none of which is meant for the vehicle.

    Args:
        results: The translations.
        threshold: Confidence below which the co-pilot asks back instead of acting.

    Returns:
        ``activation_rate`` is the share that becomes any command, a question to the vehicle included, and
        ``motion_rate`` the share that would change how, where or whether it drives; both as the co-pilot acts, asking
        back where it is unsure. ``translated`` holds the same for the model alone.
    """
    acted = [effect(run_of(result.got, result.confidence, threshold)) for result in results]
    return {
        "n": len(results),
        **_rates(acted),
        "translated": _rates([effect(result.got) for result in results]),
        "by_tag": {tag: _tagged(results, acted, tag) for tag in sorted({tag for r in results for tag in r.tags})},
        "latency_ms": latency([result.latency_ms for result in results]),
        "activations": [
            {
                "id": result.id,
                "instruction": result.instruction,
                "got": result.got,
                "confidence": round(result.confidence, 4),
                "effect": done.value,
            }
            for result, done in zip(results, acted, strict=True)
            if done is not Effect.NONE
        ],
    }


def _rates(effects: Sequence[Effect]) -> dict[str, float]:
    count = max(1, len(effects))
    return {
        "activation_rate": round(sum(done is not Effect.NONE for done in effects) / count, 4),
        "motion_rate": round(sum(done is Effect.MOTION for done in effects) / count, 4),
    }


def _tagged(results: Sequence[Result], acted: Sequence[Effect], tag: str) -> dict[str, float]:
    chosen = [done for result, done in zip(results, acted, strict=True) if tag in result.tags]
    return {"n": len(chosen), **_rates(chosen)}
