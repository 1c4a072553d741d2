"""Data files of instructions with their programs (language.md section 7): JSON Lines, one record a line."""

from collections.abc import Iterator
from pathlib import Path

from pydantic import BaseModel, ConfigDict, ValidationError

from wayword.compiler import VehicleStatus
from wayword.models.validation import explain


class DatasetError(Exception):
    """A data file that can't be read. The message names the file and the line."""


class Record(BaseModel):
    """An instruction with the program that it means.

    Attributes:
        id: Unique in its file.
        instruction: What the passenger says.
        program: The program in canonical form.
        category: The command type of the program's first command.
        status: The vehicle status to translate under, None for the default one.
        places: The names on the map, None for the town's.
        tags: For breakdowns.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    id: str
    instruction: str
    program: str
    category: str
    status: VehicleStatus | None = None
    places: tuple[str, ...] | None = None
    tags: tuple[str, ...] = ()


def read_records(path: Path) -> Iterator[Record]:
    """Reads a data file.

    Raises:
        DatasetError: The file or one of its lines can't be read.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise DatasetError(f"{path}: {error}") from error
    yield from parse_records(text, str(path))


def parse_records(text: str, name: str) -> Iterator[Record]:
    """Reads the lines of a data file.

    Args:
        text: Its content.
        name: What messages call it.

    Raises:
        DatasetError: One of the lines is no record.
    """
    for number, line in enumerate(text.split("\n"), start=1):
        if not line.strip():
            continue
        try:
            yield Record.model_validate_json(line)
        except ValidationError as error:
            raise DatasetError(f"{name}:{number}: {explain(error, Record)}") from error
