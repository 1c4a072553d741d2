"""When to ask back instead of acting."""

import re

from wayword.models.translator import Translation

# Chosen on dev.jsonl by `wayword eval confidence` (docs/evaluation.md).
ASK_BACK_BELOW = 0.5

ASK_BACK = "command_type: OUT_OF_SCOPE\naction: CLARIFY\nparameters:\n  - name: about\n    value: command\n"
_EMERGENCY_STOP = "command_type: INTERVENTION\naction: EMERGENCY_STOP\n"

_ACTION = re.compile(r"(?m)^action: (\w+)$")
_HARMLESS = frozenset({"QUERY", "REJECT", "CLARIFY"})


def asks_back(translation: Translation, threshold: float = ASK_BACK_BELOW) -> bool:
    """Whether the model is too unsure of a program for the vehicle to act on it.

    Args:
        translation: The program with the model's confidence in it.
        threshold: Least confidence to act on.
    """
    return program_to_run(translation, threshold) == ASK_BACK != translation.program


def program_to_run(translation: Translation, threshold: float = ASK_BACK_BELOW) -> str:
    """The program, or the question that takes its place; see :func:`run_of`."""
    return run_of(translation.program, translation.confidence, threshold)


def run_of(program: str, confidence: float, threshold: float = ASK_BACK_BELOW) -> str:
    """What the vehicle is given of a program that the model is more or less sure of.

    Args:
        program: The program.
        confidence: The model's, 0 to 1.
        threshold: Least confidence to act on.

    Returns:
        The program itself if the model is sure of it or it does no harm, else a question. Of a doubtful program with an
        emergency stop in it, that alone: one wanted in vain does less harm than one left out, or one that waits for
        other doubtful commands.
    """
    actions = set(_ACTION.findall(program))
    if confidence >= threshold or actions <= _HARMLESS:
        return program
    return _EMERGENCY_STOP if "EMERGENCY_STOP" in actions else ASK_BACK
