"""The event log of a session: JSON Lines, one event a line. Every plot and table is made from it."""

import json
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Any, Self

Event = dict[str, Any]


class LogError(Exception):
    """A log that can't be read. The message names the file and the line."""


class Recorder:
    """Writes events, each whole line at once, so that a log is intact up to the last whole line.

    Every event has ``event``, its kind, and ``t``, the simulated time in seconds.

    Args:
        path: The log; an earlier one is replaced. Its folder is made.
    """

    def __init__(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        self.path = path
        self._file = path.open("w", encoding="utf-8")

    def record(self, event: str, t: float, **fields: object) -> None:
        """Adds an event."""
        line = json.dumps({"event": event, "t": round(t, 3), **fields}, ensure_ascii=False)
        self._file.write(line + "\n")
        self._file.flush()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()


def read_log(path: Path) -> Iterator[Event]:
    """Reads a log.

    Raises:
        LogError: The file or a line in it can't be read.
    """
    try:
        lines = path.read_text(encoding="utf-8").removesuffix("\n").split("\n")
    except (OSError, UnicodeDecodeError) as error:
        raise LogError(f"{path}: {error}") from error
    for number, line in enumerate(lines, start=1):
        try:
            event: Event = json.loads(line)
        except json.JSONDecodeError as error:
            raise LogError(f"{path}:{number}: {error.msg}") from error
        yield event
