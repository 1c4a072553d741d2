"""What a translated program amounts to, beside the one that was meant."""

import re
from collections.abc import Sequence
from enum import StrEnum

from wayword.compiler import compile_program, equivalent

_ACTION = re.compile(r"(?m)^action: (\w+)$")
_SAID_ONLY = frozenset({"REJECT", "CLARIFY"})
_ASKED_ONLY = frozenset({"QUERY"})


class Effect(StrEnum):
    """What a program would do, at most."""

    NONE = "none"  # it is refused, or answered with a question
    ANSWER = "answer"  # the passenger is told something
    MOTION = "motion"  # it changes how, where or whether the vehicle drives


def parses(program: str, places: Sequence[str]) -> bool:
    """Whether a text is a program, by its syntax; its places and values may be wrong."""
    return not any(d.code.name.startswith("WW01") for d in compile_program(program, places).diagnostics)


def same_program(one: str, other: str, places: Sequence[str]) -> bool:
    """Whether two texts are equal programs (language.md section 1).

    Programs that the compiler refuses, such as a speed out of bounds, are equal if their texts are.
    """
    if one == other:
        return True
    ours, theirs = compile_program(one, places).program, compile_program(other, places).program
    return ours is not None and theirs is not None and equivalent(ours, theirs)


def effect(program: str) -> Effect:
    """What a program would do, were it carried out."""
    actions = set(_ACTION.findall(program))
    if actions <= _SAID_ONLY:
        return Effect.NONE
    return Effect.ANSWER if actions <= _SAID_ONLY | _ASKED_ONLY else Effect.MOTION
