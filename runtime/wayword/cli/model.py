"""Loads the language model, telling the user what takes so long."""

from collections.abc import Sequence
from time import perf_counter

from rich.markup import escape

from wayword.cli.common import errors
from wayword.models import Translator, model_path
from wayword.models.embedded import EmbeddedModel


def load_translator(model: str | None, places: Sequence[str]) -> tuple[Translator, float]:
    """Loads a model and has it read the constant part of the prompt.

    Args:
        model: A GGUF file, None for the embedded model.
        places: Names on the loaded map.

    Returns:
        The translator and how long that took, in seconds.

    Raises:
        ModelError: The model can't be loaded.
    """
    path = model_path(model)
    what = f"reading {escape(path.name)} and the knowledge base; this takes some 10 s, more on a busy machine"
    started = perf_counter()
    if not errors.is_terminal:  # where a status line would not show
        errors.print(f"{what} …", soft_wrap=True)
    with errors.status(f"{what} …"):
        translator = Translator(EmbeddedModel(path), places)
        translator.prepare()
    took = perf_counter() - started
    errors.print(f"[dim]model ready after {took:.1f} s[/]")
    return translator, took
