"""``wayword eval``: how well instructions are translated."""

import click

from wayword.cli.common import LazyCommand, LazyGroup

_COMMANDS = {
    "translation": LazyCommand("wayword.cli.evaluate.translation", "translation", "Accuracy on a data file."),
    "lampilot": LazyCommand("wayword.cli.evaluate.lampilot", "lampilot", "LaMPilot-Bench, a peer's benchmark."),
    "activation": LazyCommand("wayword.cli.evaluate.activation", "activation", "Speech not meant for the vehicle."),
    "attack": LazyCommand("wayword.cli.evaluate.attack", "attack", "Adversarial instructions."),
    "confidence": LazyCommand("wayword.cli.evaluate.confidence", "confidence", "Risk and coverage of asking back."),
    "ablation": LazyCommand("wayword.cli.evaluate.ablation", "ablation", "Prompts, tuning and constraint compared."),
}


@click.group(name="eval", cls=LazyGroup, lazy=_COMMANDS)
def evaluate() -> None:
    """Measure how well instructions are translated.

    The data files are JSON Lines (docs/language.md, section 7). The sets that ship with Wayword go by name:
    benchmark, dev, activation, attack, lampilot.
    """
