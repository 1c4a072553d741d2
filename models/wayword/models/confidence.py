"""When to ask back instead of acting."""

import re

from wayword.models.translator import Translation

# Chosen on dev.jsonl by `wayword eval confidence` (docs/evaluation.md).
ASK_BACK_BELOW = 0.5

ASK_BACK = "command_type: OUT_OF_SCOPE\naction: CLARIFY\nparameters:\n  - name: about\n    value: command\n"

_ACTION = re.compile(r"(?m)^action: (\w+)$")
# Answers and questions do no harm; an emergency stop wanted in vain does less than one left out.
_WITHOUT_DOUBT = frozenset({"QUERY", "REJECT", "CLARIFY", "EMERGENCY_STOP"})


def asks_back(translation: Translation, threshold: float = ASK_BACK_BELOW) -> bool:
    """Whether the model is too unsure of a program for the vehicle to act on it.

    Args:
        translation: The program with the model's confidence in it.
        threshold: Least confidence to act on.
    """
    return translation.confidence < threshold and not set(_ACTION.findall(translation.program)) <= _WITHOUT_DOUBT


def program_to_run(translation: Translation, threshold: float = ASK_BACK_BELOW) -> str:
    """The program, or the question that takes its place."""
    return ASK_BACK if asks_back(translation, threshold) else translation.program
