"""Values that a sentence names by reference to the vehicle status: "ten under the limit"."""

import ast
import operator
import re
from collections.abc import Mapping
from random import Random

from wayword.compiler import VehicleStatus
from wayword.models.training.augment.numbers import say

_OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}
_FIELD = re.compile(r"\{([^}]*)\}")
CLARIFY_VALUE = "command_type: OUT_OF_SCOPE\naction: CLARIFY\nparameters:\n  - name: about\n    value: value\n"


def fill(sentence: str, program: str, status: VehicleStatus, rng: Random) -> tuple[str, str] | None:
    """Fills a template for a vehicle status.

    Args:
        sentence: May hold ``{n}``, a number to be said.
        program: May hold expressions over ``n``, ``speed``, ``limit``, ``gap``, ``max_vel``, ``following_distance``.
        status: Gives their values, in km/h, m and s.
        rng: For the number and how it is said.

    Returns:
        Sentence and program. Where the status doesn't know a value, the program asks for it. None where the result
        would be no sensible value.
    """
    known = {name: value for name, value in _values(status).items() if value is not None}
    expressions = _FIELD.findall(program)
    names = {node.id for text in expressions for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Name)} - {
        "n"
    }
    number = rng.choice((5, 10, 15, 20, rng.randint(2, 30)))
    said = say(number, rng, words=rng.random() < 0.6)
    if "{n}" in sentence and sentence.startswith("{n}") and said[0].isalpha() and rng.random() < 0.6:
        said = said.capitalize()
    sentence = sentence.replace("{n}", said)
    if missing := names - known.keys():
        asks = "---" not in program and missing <= {"speed", "limit", "gap"}
        return (sentence, CLARIFY_VALUE) if asks else None
    values = [evaluate(text, {**known, "n": number}) for text in expressions]
    if any(value < 1 or value > 200 or value != round(value, 1) for value in values):
        return None
    filled = iter(values)
    return sentence, _FIELD.sub(lambda _: f"{next(filled):g}", program)


def evaluate(expression: str, values: Mapping[str, float]) -> float:
    """Evaluates sums, differences, products and quotients of numbers and names."""
    return round(_evaluate(ast.parse(expression, mode="eval").body, values), 6)


def _evaluate(node: ast.expr, values: Mapping[str, float]) -> float:
    if isinstance(node, ast.BinOp):
        return float(_OPERATORS[type(node.op)](_evaluate(node.left, values), _evaluate(node.right, values)))
    if isinstance(node, ast.Name):
        return values[node.id]
    assert isinstance(node, ast.Constant) and isinstance(node.value, int | float)
    return node.value


def _values(status: VehicleStatus) -> dict[str, float | None]:
    def setting(name: str, unit: str) -> float | None:
        number, _, has = status.settings.get(name, "").partition(" ")
        return float(number) if has == unit else None

    return {
        "speed": status.speed_kmh,
        "limit": status.speed_limit_kmh,
        "gap": status.lead_gap_m,
        "max_vel": setting("max_vel", "km/h"),
        "following_distance": setting("following_distance", "s"),
    }
