"""Accuracy of translation on a data file."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from wayword.compiler import VehicleStatus
from wayword.models.backend import InstructionError
from wayword.models.dataset import Record
from wayword.models.evaluation.judgement import parses, same_program
from wayword.models.translator import Translation, Translator

TranslatorFor = Callable[[tuple[str, ...]], Translator]


@dataclass(frozen=True, slots=True)
class Result:
    """What became of one instruction.

    Attributes:
        id: The record's.
        instruction: What was said.
        category: The record's.
        tags: The record's.
        expected: The program that was meant.
        got: The program that the model wrote; empty where it didn't read the instruction.
        correct: Whether the two are equal.
        parsed: Whether what it wrote is a program.
        confidence: The model's, 0 to 1.
        latency_ms: Wall-clock time.
        tokens: Number of tokens in the program.
    """

    id: str
    instruction: str
    category: str
    tags: tuple[str, ...]
    expected: str
    got: str
    correct: bool
    parsed: bool
    confidence: float
    latency_ms: float
    tokens: int


def translate_all(
    translator_for: TranslatorFor,
    town: Sequence[str],
    records: Iterable[Record],
    *,
    constrained: bool = True,
    on_result: Callable[[Result], None] = lambda _: None,
) -> list[Result]:
    """Translates every record and compares.

    Args:
        translator_for: Gives the translator for a map's places.
        town: Places of the records that name none.
        records: What to translate.
        constrained: Whether the model can only emit programs.
        on_result: Called after each record, for progress.
    """
    results = []
    for record in records:
        translator = translator_for(record.places or tuple(town))
        results.append(judge(record, _translate(translator, record, constrained=constrained), translator.places))
        on_result(results[-1])
    return results


def judge(record: Record, translation: Translation, places: Sequence[str]) -> Result:
    """Compares a translation with what was meant."""
    return Result(
        id=record.id,
        instruction=record.instruction,
        category=record.category,
        tags=record.tags,
        expected=record.program,
        got=translation.program,
        correct=same_program(translation.program, record.program, places),
        parsed=parses(translation.program, places),
        confidence=translation.confidence,
        latency_ms=translation.latency_ms,
        tokens=translation.tokens,
    )


def summary(results: Sequence[Result]) -> dict[str, Any]:
    """The figures of an evaluation, as ``wayword eval translation --json`` prints them."""
    return {
        "n": len(results),
        "correct": sum(result.correct for result in results),
        "accuracy": _share(result.correct for result in results),
        "parse_rate": _share(result.parsed for result in results),
        "latency_ms": latency([result.latency_ms for result in results]),
        "by_category": _breakdown((result.category, result) for result in results),
        "by_tag": _breakdown((tag, result) for result in results for tag in result.tags),
        "errors": [
            {
                "id": result.id,
                "instruction": result.instruction,
                "expected": result.expected,
                "got": result.got,
                "confidence": round(result.confidence, 4),
            }
            for result in results
            if not result.correct
        ],
    }


def latency(milliseconds: Sequence[float]) -> dict[str, float | None]:
    """Mean, median and 95th percentile, in ms; None where nothing was measured."""
    if not milliseconds:
        return {"mean": None, "median": None, "p95": None}
    values = np.asarray(milliseconds)
    return {
        "mean": round(float(values.mean()), 1),
        "median": round(float(np.median(values)), 1),
        "p95": round(float(np.percentile(values, 95)), 1),
    }


def to_json(result: Result) -> dict[str, Any]:
    """A result as kept in a file."""
    return asdict(result)


def from_json(fields: Mapping[str, Any]) -> Result:
    """A result as read from a file."""
    return Result(**{**fields, "tags": tuple(fields["tags"])})


def _translate(translator: Translator, record: Record, *, constrained: bool) -> Translation:
    try:
        return translator.translate(record.instruction, record.status or VehicleStatus(), constrained=constrained)
    except InstructionError:  # too long, or no text: the passenger is told so, and nothing happens
        return Translation("", latency_ms=0.0, tokens=0, forced_tokens=0, confidence=0.0, finished=False)


def _breakdown(pairs: Iterable[tuple[str, Result]]) -> dict[str, dict[str, float]]:
    groups: dict[str, Counter[bool]] = defaultdict(Counter)
    for key, result in pairs:
        groups[key][result.correct] += 1
    return {
        key: {"n": count.total(), "correct": count[True], "accuracy": round(count[True] / count.total(), 4)}
        for key, count in groups.items()
    }


def _share(values: Iterable[bool]) -> float:
    listed = list(values)
    return round(sum(listed) / len(listed), 4) if listed else 0.0
