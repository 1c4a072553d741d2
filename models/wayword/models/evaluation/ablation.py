"""The published table: what knowledge base, examples, status, tuning and constraint are worth."""

import hashlib
import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from wayword.models.dataset import Record
from wayword.models.evaluation.translation import Result, TranslatorFor, from_json, to_json, translate_all
from wayword.models.prompt import PromptStyle


@dataclass(frozen=True, slots=True)
class Configuration:
    """One row of the table.

    Attributes:
        style: The prompt.
        tuned: Whether the model has its adapter.
        constrained: Whether it can only emit programs.
    """

    style: PromptStyle
    tuned: bool
    constrained: bool

    @property
    def name(self) -> str:
        """For tables, plots and files."""
        return f"{'tuned' if self.tuned else 'untuned'} {self.style.value} {'grammar' if self.constrained else 'free'}"


def configurations() -> Iterator[Configuration]:
    """All rows: the four published prompts with each model, and the short prompt with the one tuned on it."""
    for constrained in (True, False):
        yield Configuration(PromptStyle.TUNED, tuned=True, constrained=constrained)
    published = (PromptStyle.BASELINE, PromptStyle.NO_STATUS, PromptStyle.ZERO_SHOT, PromptStyle.KB_ONLY)
    for tuned in (True, False):
        for style in published:
            for constrained in (True, False):
                yield Configuration(style, tuned=tuned, constrained=constrained)


def measure(
    configuration: Configuration,
    translator_for: TranslatorFor,
    town: Sequence[str],
    records: Sequence[Record],
    kept: Path,
    on_result: Callable[[Result], None],
) -> list[Result]:
    """Translates all records under a configuration; what an earlier, interrupted call did is read from its file.

    Args:
        configuration: The row.
        translator_for: Gives the translator for a map's places.
        town: Places of the records that name none.
        records: What to translate.
        kept: The JSON Lines file of the results.
        on_result: Called for each result, old or new.
    """
    model = translator_for(tuple(town)).model.name
    header = json.dumps({"configuration": configuration.name, "model": model, "data": digest(records)})
    done = _read(kept, header)
    for result in done:
        on_result(result)
    kept.parent.mkdir(parents=True, exist_ok=True)
    with kept.open("a" if done else "w", encoding="utf-8") as file:
        if not done:
            file.write(header + "\n")

        def keep(result: Result) -> None:
            file.write(json.dumps(to_json(result), ensure_ascii=False) + "\n")
            file.flush()
            on_result(result)

        rest = records[len(done) :]
        return done + translate_all(translator_for, town, rest, constrained=configuration.constrained, on_result=keep)


def digest(records: Sequence[Record]) -> str:
    """Short digest of a data set, so that results of another one aren't taken for its own."""
    text = "\n".join(record.model_dump_json() for record in records)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _read(kept: Path, header: str) -> list[Result]:
    """The results in a file, none if it belongs to something else; a line cut off by a crash is dropped."""
    if not kept.exists():
        return []
    content = kept.read_bytes()  # a crash may cut a line off amid a character
    lines = content[: content.rfind(b"\n") + 1].decode("utf-8").removesuffix("\n").split("\n")
    if lines[0] != header:
        return []
    kept.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return [from_json(json.loads(line)) for line in lines[1:]]
