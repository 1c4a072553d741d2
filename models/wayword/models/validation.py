"""Checks of input, and what to say of it in a line."""

from pydantic import ValidationError


def is_text(text: str) -> bool:
    """Whether a text can be written as UTF-8; half a surrogate pair, as of bytes that were no text, can't."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def explain(error: ValidationError) -> str:
    """Names every mistake that pydantic found: where it is and what is wrong with it."""
    mistakes = []
    for mistake in error.errors():
        where = ".".join(str(part) for part in mistake["loc"])
        message = mistake["msg"].removeprefix("Value error, ")
        mistakes.append(f"{where}: {message}" if where else message)
    return "; ".join(mistakes)
