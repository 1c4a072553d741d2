"""Checks of input, and what to say of it in a line."""

import unicodedata
from collections.abc import Sequence
from typing import TypeGuard, get_args

from pydantic import BaseModel, ValidationError

from wayword.compiler.suggestions import suggest

# Control, format, private and unassigned characters, and marks that NFKC could not compose with their letter.
_INVISIBLE = frozenset({"Cc", "Cf", "Cn", "Co", "Mn", "Me"})
_STRAIGHT = str.maketrans(dict.fromkeys("‘’‚‛´`", "'") | dict.fromkeys("“”„‟", '"'))


def is_text(text: str) -> bool:
    """Whether a text can be written as UTF-8; half a surrogate pair, as of bytes that were no text, can't."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def clean(instruction: str) -> str:
    """What a passenger can have said of what was received: no invisible, control or stacked characters.

    Compatibility forms become plain ones (NFKC), typographic quotes straight ones, any space a single one. What can't
    be seen can't be meant: zero-width and tag characters, text direction marks, and marks piled on letters go.
    """
    text = unicodedata.normalize("NFKC", instruction.translate(_STRAIGHT))
    spaced = (" " if character.isspace() else character for character in text)
    return " ".join("".join(c for c in spaced if unicodedata.category(c) not in _INVISIBLE).split())


def explain(error: ValidationError, model: type[BaseModel]) -> str:
    """Names every mistake that pydantic found: where it is, what is wrong with it, and what may be meant.

    Args:
        error: The mistakes.
        model: The model that was to be read.
    """
    mistakes = []
    for mistake in error.errors():
        where = ".".join(str(part) for part in mistake["loc"])
        message = mistake["msg"].removeprefix("Value error, ")
        if mistake["type"] == "extra_forbidden":
            message = f"unknown key; {suggest(str(mistake['loc'][-1]), _keys(model, mistake['loc'][:-1]))}"
        mistakes.append(f"{where}: {message}" if where else message)
    return "; ".join(mistakes)


def _keys(model: type[BaseModel], path: Sequence[int | str]) -> list[str]:
    """The keys that may stand at a place in a document."""
    for part in path:
        if isinstance(part, str) and part in model.model_fields:
            annotation = model.model_fields[part].annotation
            model = next(filter(_is_model, (annotation, *get_args(annotation))), model)
    return [field.alias or name for name, field in model.model_fields.items()]


def _is_model(annotation: object) -> TypeGuard[type[BaseModel]]:
    return isinstance(annotation, type) and issubclass(annotation, BaseModel)
