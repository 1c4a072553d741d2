"""Loads the language model, telling the user what takes so long."""

from collections.abc import Sequence
from time import perf_counter

from rich.markup import escape

from wayword.cli.common import errors
from wayword.models import PromptStyle, Translator, adapter_path, find_weights, model_path
from wayword.models.adapter import is_cached
from wayword.models.embedded import EmbeddedModel


def load_translator(
    model: str | None, adapter: str | None, places: Sequence[str], style: PromptStyle | None = None
) -> tuple[Translator, float]:
    """Loads a model and has it read the constant part of the prompt.

    Args:
        model: A GGUF file, None for the embedded model.
        adapter: A GGUF file, "none", or None for the one that belongs to the model.
        places: Names on the loaded map.
        style: The prompt, None for the one that the weights need.

    Returns:
        The translator and how long that took, in seconds.

    Raises:
        ModelError: The model can't be loaded.
    """
    started = perf_counter()
    base, lora = model_path(model), adapter_path(model, adapter)
    if lora is not None and not is_cached(base, lora):
        _announce(f"merging {escape(lora.name)} into {escape(base.name)}, once; this takes some seconds")
    weights = find_weights(model, adapter)
    style = style or weights.style
    if style is not PromptStyle.TUNED:
        _announce(f"reading {escape(base.name)} and the knowledge base; some 10 s, more on a busy machine")
    translator = Translator(EmbeddedModel(weights.path), places, style)
    translator.prepare()
    took = perf_counter() - started
    errors.print(f"[dim]model ready after {took:.1f} s[/]")
    return translator, took


def _announce(what: str) -> None:
    errors.print(f"[dim]{what} …[/]", soft_wrap=True)
