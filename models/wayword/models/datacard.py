"""The tables of the data card: ``python -m wayword.models.datacard`` prints them from the data files."""

import re
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib.resources import files
from importlib.resources.abc import Traversable

from wayword.compiler.vocabulary import ACTIONS, Choice, CommandType
from wayword.models.dataset import Record, parse_records
from wayword.models.datasets import TEST_SETS

_ACTION = re.compile(r"(?m)^action: (\w+)$")

DataSets = Mapping[str, Sequence[Record]]


def tables() -> str:
    """All tables of the card, in Markdown."""
    training, others = _training_files(), _other_files()
    return "\n".join(
        [
            "### Files\n",
            _files_table({**training, **others}, training),
            "### Commands per action\n",
            _counts_table("action", list(ACTIONS), _actions, _columns(training, others)),
            "### Reasons and questions\n",
            _counts_table("value", _words_of_refusal(), _refusals, _columns(training, others)),
            "### Tags of the sets that aren't trained on\n",
            _tags_table(others),
            "### Lists of names\n",
            _names_table(),
        ]
    )


def _data() -> Traversable:
    return files("wayword.models").joinpath("data")


def _read(path: str) -> list[Record]:
    return list(parse_records(_data().joinpath(path).read_text(encoding="utf-8"), path))


def _training_files() -> DataSets:
    names = sorted(file.name for file in _data().joinpath("train").iterdir() if file.name.endswith(".jsonl"))
    return {f"train/{name}": _read(f"train/{name}") for name in names}


def _other_files() -> DataSets:
    return {f"{name}.jsonl": _read(f"{name}.jsonl") for name in (*TEST_SETS, "examples")}


def _columns(training: DataSets, others: DataSets) -> DataSets:
    """All training records in one column, then each test set in its own."""
    all_training = [record for records in training.values() for record in records]
    return {"training": all_training, **{name: others[f"{name}.jsonl"] for name in TEST_SETS}}


def _files_table(records: DataSets, training: DataSets) -> str:
    rows = [_file_row(name, records[name]) for name in training]
    rows.append(_file_row("**training, all**", [record for name in training for record in records[name]]))
    rows += [_file_row(name, records[name]) for name in records if name not in training]
    header = ["file", "records", *(str(kind) for kind in CommandType), "several commands", "own places", "own status"]
    return _table(header, rows)


def _file_row(name: str, records: Sequence[Record]) -> list[str]:
    categories = Counter(record.category for record in records)
    counts = [
        len(records),
        *(categories[kind] for kind in CommandType),
        sum("---" in record.program for record in records),
        sum(record.places is not None for record in records),
        sum(record.status is not None for record in records),
    ]
    return [name, *map(_number, counts)]


def _counts_table(
    title: str, words: Sequence[str], words_of: Callable[[Record], Iterable[str]], columns: DataSets
) -> str:
    counts = {
        name: Counter(word for record in records for word in words_of(record)) for name, records in columns.items()
    }
    return _table([title, *columns], [[word, *(_number(counts[name][word]) for name in columns)] for word in words])


def _actions(record: Record) -> list[str]:
    return _ACTION.findall(record.program)


def _refusals(record: Record) -> list[str]:
    found = re.findall(r"action: (REJECT|CLARIFY)\nparameters:\n  - name: \w+\n    value: (\w+)\n", record.program)
    return [f"{action} {value}" for action, value in found]


def _words_of_refusal() -> list[str]:
    return [
        f"{name} {option}"
        for name in ("REJECT", "CLARIFY")
        for parameter in ACTIONS[name].parameters
        if isinstance(parameter.type, Choice)
        for option in parameter.type.options
    ]


def _tags_table(records: DataSets) -> str:
    rows = [
        [name, tag, _number(count)]
        for name, of_file in records.items()
        for tag, count in sorted(Counter(tag for record in of_file for tag in record.tags).items())
    ]
    return _table(["file", "tag", "records"], rows)


def _names_table() -> str:
    names = ("place_names.txt", "unknown_places.txt")
    lines = (len(_data().joinpath("train", name).read_text(encoding="utf-8").splitlines()) for name in names)
    return _table(
        ["file", "names"], [[f"train/{name}", _number(count)] for name, count in zip(names, lines, strict=True)]
    )


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [header, ["---"] + ["---:" if _is_number(cell) else "---" for cell in rows[0][1:]], *rows]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


def _number(count: int) -> str:
    return f"{count:,}" if count else "–"


def _is_number(cell: str) -> bool:
    return cell == "–" or cell[0].isdigit()


if __name__ == "__main__":
    sys.stdout.write(tables())
