"""Left for right and right for left."""

import re

_SIDE = re.compile(r"\b(left|right)\b", re.IGNORECASE)
_OTHER = {"left": "right", "right": "left"}
# Where "right" is no side.
_NO_SIDE = re.compile(
    r"\b(all right|alright|that's right|is right|what's left|have left|(right|left) (over|out|alone|to)"
    r"|right (now|away|here|there|behind|ahead|in front|at|up|on|after|before|then|of way))\b|right[?.!,]",
    re.IGNORECASE,
)


def mirror(sentence: str, program: str) -> tuple[str, str] | None:
    """Swaps the sides in a sentence and its program, or None where that would change more than sides."""
    said = {match.lower() for match in _SIDE.findall(sentence)}
    meant = set(re.findall(r"value: (left|right)\n", program))
    mirrored = _SIDE.sub(_swap, sentence)
    # What reads as no side after the swap is left alone too: else there would be more rights than lefts.
    if not meant or said != meant or _NO_SIDE.search(sentence) or _NO_SIDE.search(mirrored):
        return None
    return mirrored, re.sub(r"(?<=value: )(left|right)(?=\n)", lambda m: _OTHER[m[0]], program)


def _swap(match: re.Match[str]) -> str:
    other = _OTHER[match[0].lower()]
    if match[0].isupper():
        return other.upper()
    return other.capitalize() if match[0][0].isupper() else other
