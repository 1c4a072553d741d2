"""What the evaluations share: data, models, progress."""

import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any

from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from wayword.cli.common import errors, make_folder
from wayword.cli.model import load_translator
from wayword.grammar import GrammarError, constraint
from wayword.models import DatasetError, PromptStyle, Record, Translator, read_records
from wayword.models.datasets import TEST_SETS, shipped_data
from wayword.models.evaluation.translation import Result, TranslatorFor, translate_all
from wayword.runtime.world import load_map


def read_data(name: str) -> list[Record]:
    """Reads a data file, or one of those that ship with Wayword, by name.

    Raises:
        DatasetError: It can't be read, or holds nothing.
    """
    try:
        records = list(read_records(shipped_data(name) or Path(name)))
    except DatasetError as error:
        if isinstance(error.__cause__, OSError):
            advice = f"give a JSON Lines file or one of: {', '.join(TEST_SETS)}"
            raise DatasetError(f"can't read {name}: {error.__cause__.strerror}; {advice}") from error
        raise
    if not records:
        raise DatasetError(f"{name} holds no instruction; add a record a line (docs/language.md, section 7)")
    for record in {record.places: record for record in records if record.places}.values():
        try:
            constraint(record.places or ())
        except GrammarError as error:
            raise DatasetError(f"{name}: places of record {record.id}: {error}") from error
    return records


def translators(model: str | None, adapter: str | None, style: PromptStyle | None) -> TranslatorFor:
    """Loads a model once, and gives translators for the places of any map."""
    first, _ = load_translator(model, adapter, town_places(), style)

    @lru_cache(maxsize=64)
    def translator_for(places: tuple[str, ...]) -> Translator:
        return first if places == first.places else Translator(first.model, places, first.style)

    return translator_for


@lru_cache(maxsize=1)
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
        task = bar.add_task(escape(title), total=total, note="")
        yield lambda note: bar.update(task, advance=1, note=note)


def keep(out: Path, name: str, value: object) -> Path:
    """Writes a result as a JSON file into a folder."""
    make_folder(out)
    target = out / name
    target.write_text(json.dumps(value, ensure_ascii=False, indent=2) + "\n", encoding="utf-8")
    return target


def percent(share: Any) -> str:
    """A share as people read it."""
    return f"{100 * float(share):.1f} %"
