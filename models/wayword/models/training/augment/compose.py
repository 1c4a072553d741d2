"""Two instructions in one sentence."""

import re
from random import Random

_JOINTS = (
    " and ", " and then ", ", then ", ", and ", ". ", ". Then ", ". And ", ", also ", " and also ", ". Oh, and ", ", ",
    ", after that ", " then ", ". Afterwards ", ". Also, ", " plus ", ", oh and ",
    ". Another thing: ", " and afterwards ", ". Next, ",
)  # fmt: skip
# What ends a program, what would change the meaning of the other part, and what needs a sentence of its own.
_ALONE = re.compile(
    r"action: (EMERGENCY_STOP|CLARIFY|STOP|START|PULL_OVER|PROCEED|\w+_WAYPOINT)"
    r"|value: (unsafe|unknown_place|unrelated)"
)
_CONTINUES = re.compile(r"(?i)\b(and|then|also|again|it|that|this|first|no|not|wait|sorry|stop)\b|[?:;“”\"]")


def can_be_part(sentence: str, program: str) -> bool:
    """Whether an instruction can be joined to another one."""
    return (
        "---" not in program
        and len(sentence) < 60
        and not _ALONE.search(program)
        and not _CONTINUES.search(sentence)
        and sentence.count(".") <= 1
        and sentence.count(",") <= 1
    )


def join(first: tuple[str, str], second: tuple[str, str], rng: Random) -> tuple[str, str] | None:
    """Joins two instructions in the order in which they are to happen, None where they ask for the same thing.

    Args:
        first: Sentence and program.
        second: Sentence and program.
        rng: For the joint.
    """
    if _key(first[1]) == _key(second[1]):
        return None
    joint = rng.choice(_JOINTS)
    head = first[0].rstrip(" .!")
    tail = second[0]
    starts_anew = joint == ". " or tail.startswith("I") or tail[1:2].isupper()
    return f"{head}{joint}{tail if starts_anew else tail[0].lower() + tail[1:]}", f"{first[1]}---\n{second[1]}"


def _key(program: str) -> tuple[str, ...]:
    """Action and first parameter: commands of equal key belong to one wish, or contradict each other."""
    action, *rest = re.findall(r"(?m)^action: (\w+)|^  - name: (\w+)", program)
    return (action[0], rest[0][1] if rest and "PARAM" in action[0] else "")
