"""The training corpus: hand-written records."""

from collections.abc import Sequence
from functools import cached_property
from importlib.resources import files
from importlib.resources.abc import Traversable
from random import Random

from wayword.models.dataset import Record, parse_records, read_records
from wayword.models.datasets import DATA, TEST_SETS
from wayword.models.training.leakage import normal_form


def data_folder() -> Traversable:
    """Where the data files of this package are."""
    return files("wayword.models").joinpath("data")


class Corpus:
    """The hand-written training data of this package.

    Args:
        town: Places of the default map, on which records without places of their own are spoken.
        sentences: Take only so many of the sentences, chosen at random, and as small a part of everything else; None
            takes all.
    """

    def __init__(self, town: Sequence[str], sentences: int | None = None) -> None:
        self.town = tuple(town)
        self._most = sentences
        self._folder = data_folder().joinpath("train")

    @cached_property
    def sentences(self) -> list[Record]:
        """Sentences with their programs, all files but the ones named below."""
        names = sorted(file.name for file in self._folder.iterdir() if file.name.endswith(".jsonl"))
        special = ("clinc150.jsonl", "references.jsonl")
        everything = [record for name in names if name not in special for record in self._read(name)]
        if self._most is None or self._most >= len(everything):
            return everything
        return Random(0).sample(everything, self._most)

    @cached_property
    def assistant_requests(self) -> list[Record]:
        """Requests to a general assistant, from CLINC-150."""
        return self._read("clinc150.jsonl")

    @cached_property
    def reference_templates(self) -> list[Record]:
        """Templates of values by reference to the status."""
        return self._read("references.jsonl")

    @cached_property
    def place_names(self) -> list[str]:
        """Names for the places of invented maps."""
        return self._folder.joinpath("place_names.txt").read_text(encoding="utf-8").split("\n")[:-1]

    @cached_property
    def unknown_places(self) -> list[str]:
        """Names of places that are on no map."""
        return self._folder.joinpath("unknown_places.txt").read_text(encoding="utf-8").split("\n")[:-1]

    @cached_property
    def held_out(self) -> frozenset[str]:
        """Normal forms of all sentences that are meant for testing; no variation may equal one."""
        records = (record for name in TEST_SETS for record in read_records(DATA / f"{name}.jsonl"))
        return frozenset(normal_form(record.instruction) for record in records)

    def _read(self, name: str) -> list[Record]:
        return list(parse_records(self._folder.joinpath(name).read_text(encoding="utf-8"), name))
