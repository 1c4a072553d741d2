"""The training corpus: hand-written records, and the endless variations that a run is trained on."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.resources import files
from importlib.resources.abc import Traversable
from random import Random

from wayword.compiler import VehicleStatus
from wayword.models.dataset import Record, parse_records
from wayword.models.training.augment import compose, noise, places, references, scenes
from wayword.models.training.augment.mirror import mirror
from wayword.models.training.augment.numbers import find_numbers, find_ordinals
from wayword.models.training.augment.quantities import vary_quantities
from wayword.models.training.encoding import Sample

# Shares of an epoch beside the hand-written sentences themselves, relative to their number.
_COMPOSED_SHARE = 0.05
_REFERENCE_SHARE = 0.045
_ASSISTANT_SHARE = 0.07  # all of the CLINC-150 requests would drown the commands
_UNKNOWN_PLACE = "command_type: OUT_OF_SCOPE\naction: REJECT\nparameters:\n  - name: reason\n    value: unknown_place\n"


def data_folder() -> Traversable:
    """Where the data files of this package are."""
    return files("wayword.models").joinpath("data")


@dataclass(frozen=True, slots=True)
class Scene:
    """Where and when a batch of instructions is spoken."""

    places: tuple[str, ...]
    status: VehicleStatus


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

    def _read(self, name: str) -> list[Record]:
        return list(parse_records(self._folder.joinpath(name).read_text(encoding="utf-8"), name))

    def epoch(self, number: int, batch_size: int, default_scene_share: float, seed: int) -> Iterator[list[Sample]]:
        """The steps of one pass over the corpus, augmented anew; equal numbers and seeds give equal samples."""
        rng = Random(f"{seed}/{number}")
        sentences = len(self.sentences)
        records = [*self.sentences, *self._composed(rng)]
        records += rng.sample(self.assistant_requests, int(_ASSISTANT_SHARE * sentences))
        records += rng.choices(self.reference_templates, k=int(_REFERENCE_SHARE * sentences))
        rng.shuffle(records)
        for start in range(0, len(records), batch_size):
            scene = self._scene(default_scene_share, rng)
            samples = [self._sample(record, scene, rng) for record in records[start : start + batch_size]]
            yield [sample for sample in samples if sample is not None]

    def steps_per_epoch(self, batch_size: int) -> int:
        """Number of steps in a pass."""
        return sum(1 for _ in self.epoch(0, batch_size, 1.0, 0))

    def _scene(self, default_share: float, rng: Random) -> Scene:
        if rng.random() < default_share:
            return Scene(self.town, VehicleStatus())
        names = self.town if rng.random() < 0.3 else places.random_map(self.place_names, rng)
        return Scene(names, scenes.random_status(names, rng))

    def _composed(self, rng: Random) -> list[Record]:
        parts = [
            record
            for record in self.sentences
            if record.places is None
            and record.status is None
            and compose.can_be_part(record.instruction, record.program)
        ]
        composed = []
        for index in range(int(_COMPOSED_SHARE * len(self.sentences))):
            one, other = rng.sample(parts, 2)
            joined = compose.join((one.instruction, one.program), (other.instruction, other.program), rng)
            if joined is not None:
                composed.append(
                    Record(id=f"composed-{index}", instruction=joined[0], program=joined[1], category=one.category)
                )
        return composed

    def _sample(self, record: Record, scene: Scene, rng: Random) -> Sample | None:
        if record.id.startswith("references-"):
            filled = references.fill(record.instruction, record.program, scene.status, rng)
            if filled is None or not set(places.in_program(self.town, filled[1])) <= set(scene.places):
                return None
            return _noisy(Sample(*filled, scene.status, scene.places), rng)
        home = record.places or self.town
        if record.status is not None or _depends_on_status(record):
            return _noisy(Sample(record.instruction, record.program, record.status or VehicleStatus(), home), rng)
        sample = self._placed(record, home, scene, rng)
        return _noisy(_varied(sample, rng), rng)

    def _placed(self, record: Record, home: tuple[str, ...], scene: Scene, rng: Random) -> Sample:
        """The record in a scene; at home, where it means something else on the scene's map."""
        said, program = record.instruction, record.program
        named = places.mentioned(home, said)
        if scene.places == home:
            return Sample(said, program, scene.status, home)
        if _UNKNOWN_PLACE in program or not places.is_movable(home, said, program) or len(named) > len(scene.places):
            if not named and not places.in_program(home, program) and places.is_free_of(scene.places, said):
                return Sample(said, program, scene.status, scene.places)
            return Sample(said, program, VehicleStatus(), home)
        if program.count("action: SET_DESTINATION") == len(named) == 1 and "---" not in program and rng.random() < 0.25:
            return Sample(self._lost(said, named[0], scene, rng), _UNKNOWN_PLACE, scene.status, scene.places)
        return Sample(*places.move(home, scene.places, said, program, rng), scene.status, scene.places)

    def _lost(self, sentence: str, place: str, scene: Scene, rng: Random) -> str:
        """The sentence with a place that isn't on the scene's map, often one that is on others."""
        candidates = self.unknown_places if rng.random() < 0.4 else [*self.place_names, *self.town]
        strangers = [name for name in rng.sample(candidates, 20) if places.is_free_of(scene.places, name)]
        return places.replace_name(place, strangers[0], sentence) if strangers else sentence.replace(place, "the moon")


def _depends_on_status(record: Record) -> bool:
    """Whether a program has a value which isn't said, or asks for one: another status might change it."""
    said = {mention.value for mention in (*find_numbers(record.instruction), *find_ordinals(record.instruction))}
    values = {float(number) for number in re.findall(r"value: [+-]?(\d+(?:\.\d+)?) ", record.program)}
    return not values <= said or "about\n    value: value" in record.program


def _varied(sample: Sample, rng: Random) -> Sample:
    """Other sides and other quantities, in most of the samples."""
    said, program = sample.instruction, sample.program
    if rng.random() < 0.25:
        said, program = mirror(said, program) or (said, program)
    if rng.random() < 0.75:
        said, program = vary_quantities(said, program, rng)
    return replace(sample, instruction=said, program=program)


def _noisy(sample: Sample, rng: Random) -> Sample:
    """Courtesy, a recogniser's spelling, slips: in a third of the samples."""
    said = sample.instruction
    if rng.random() < 0.12 and "CLARIFY" not in sample.program and len(said) > 8:
        said = noise.add_courtesy(said, rng)
    kind = rng.random()
    if kind < 0.18:
        said = noise.as_heard(said, rng)
        said = noise.mishear(said, rng) if kind < 0.05 else said
    elif kind < 0.24:
        said = noise.mistype(said, rng)
    return replace(sample, instruction=said)
