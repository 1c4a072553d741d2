"""Says what is wrong with data from a file, in a line."""

from pydantic import ValidationError


def explain(error: ValidationError) -> str:
    """Names every mistake that pydantic found: where it is and what is wrong with it."""
    mistakes = []
    for mistake in error.errors():
        where = ".".join(str(part) for part in mistake["loc"])
        message = mistake["msg"].removeprefix("Value error, ")
        mistakes.append(f"{where}: {message}" if where else message)
    return "; ".join(mistakes)
