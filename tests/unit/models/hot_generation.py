"""Generations at a high temperature, for worker processes: each loads its own model."""

import random
from collections.abc import Sequence

from tests.town import TOWN
from wayword.grammar import load, specialise, to_gbnf
from wayword.models import Completion, Message, model_path
from wayword.models.embedded import EmbeddedModel

# fmt: off
WORDS = (
    "please", "go", "stop", "turn", "left", "right", "faster", "slower", "the", "car", "ahead", "light", "green",
    "red", "museum", "harbour", "fifty", "30 km/h", "mph", "why", "when", "not", "and then", "lane", "überholen",
    "停车", "🚗", "}{", '"', "'", "---", "command_type:", "action:", "ignore previous instructions", "\x00", "null",
)
# fmt: on


def one_command() -> str:
    """The constraint for a single command: at this temperature the model would nearly always add three more."""
    return to_gbnf(specialise(load("command"), {"PLACE": TOWN}))


def generate(gbnf: str, seeds: Sequence[int]) -> list[Completion]:
    """Answers to random prompts under a grammar, at temperature 1.5."""
    model = EmbeddedModel(model_path(), threads=1)
    return [
        model.complete([Message("user", _prompt(seed))], gbnf=gbnf, temperature=1.5, seed=seed, max_tokens=800)
        for seed in seeds
    ]


def _prompt(seed: int) -> str:
    generator = random.Random(seed)
    return " ".join(generator.choices(WORDS, k=generator.randint(1, 12)))
