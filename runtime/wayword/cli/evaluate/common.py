"""What the evaluations share: data, models, progress."""

import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from wayword.cli.common import errors
from wayword.cli.model import load_translator
from wayword.models import DatasetError, PromptStyle, Record, Translator, read_records
from wayword.models.datasets import shipped_data
from wayword.models.evaluation.translation import Result, TranslatorFor, translate_all
from wayword.runtime.world import load_map


def read_data(name: str) -> list[Record]:
    """Reads a data file, or one of those that ship with Wayword, by name.

    Raises:
        DatasetError: It can't be read, or holds nothing.
    """
    records = list(read_records(shipped_data(name) or Path(name)))
    if not records:
        raise DatasetError(f"{name} holds no instruction")
    return records


def translators(model: str | None, adapter: str | None, style: PromptStyle | None) -> TranslatorFor:
    """Loads a model once, and gives translators for the places of any map."""
    first, _ = load_translator(model, adapter, town_places(), style)

    @lru_cache(maxsize=64)
    def translator_for(places: tuple[str, ...]) -> Translator:
        return first if places == first.places else Translator(first.model, places, first.style)

    return translator_for


def town_places() -> tuple[str, ...]:
    """Places of the default map."""
    return tuple(load_map("town").place_names)


def run(
    translator_for: TranslatorFor, records: Sequence[Record], *, constrained: bool = True, title: str = "translating"
) -> list[Result]:
    """Translates all records behind a progress bar."""
    with progress(title, len(records)) as advance:
        right = 0

        def on_result(result: Result) -> None:
            nonlocal right
            right += result.correct
            advance(f"{right} right")

        return translate_all(translator_for, town_places(), records, constrained=constrained, on_result=on_result)


@contextmanager
def progress(title: str, total: int) -> Iterator[Callable[[str], None]]:
    """A progress bar on standard error; what is yielded takes one step and shows a note."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, TextColumn("{task.fields[note]}"), console=errors, transient=True) as bar:
        task = bar.add_task(title, total=total, note="")
        yield lambda note: bar.update(task, advance=1, note=note)


def keep(out: Path, name: str, value: object) -> Path:
    """Writes a result as a JSON file into a folder."""
    out.mkdir(parents=True, exist_ok=True)
    target = out / name
    target.write_text(json.dumps(value, ensure_ascii=False, indent=2) + "\n", encoding="utf-8")
    return target


def percent(share: Any) -> str:
    """A share as people read it."""
    return f"{100 * float(share):.1f} %"
