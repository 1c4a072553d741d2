"""A pass over the corpus: which instructions a step holds, in which scene, and how they are varied."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from random import Random

from wayword.compiler import VehicleStatus
from wayword.models.dataset import Record
from wayword.models.training.augment import compose, noise, places, references, scenes
from wayword.models.training.augment.mirror import mirror
from wayword.models.training.augment.numbers import find_numbers, find_ordinals
from wayword.models.training.augment.quantities import vary_quantities
from wayword.models.training.corpus import Corpus
from wayword.models.training.encoding import Sample
from wayword.models.training.leakage import normal_form
from wayword.models.training.recipe import Recipe

# Shares of an epoch beside the hand-written sentences themselves, relative to their number.
_COMPOSED_SHARE = 0.05
_REFERENCE_SHARE = 0.045
_ASSISTANT_SHARE = 0.07  # all of the CLINC-150 requests would drown the commands
_UNKNOWN_PLACE = "command_type: OUT_OF_SCOPE\naction: REJECT\nparameters:\n  - name: reason\n    value: unknown_place\n"


@dataclass(frozen=True, slots=True)
class Scene:
    """Where and when the instructions of a step are spoken.

    Steps are of one scene, since what its instructions have in common in the prompt is evaluated once for all of them.
    """

    places: tuple[str, ...]
    status: VehicleStatus


def epoch(corpus: Corpus, recipe: Recipe, number: int) -> Iterator[list[Sample]]:
    """The steps of one pass, augmented anew; equal numbers and recipes give equal samples."""
    rng = Random(f"{recipe.seed}/{number}")
    for scene, records in _plan(corpus, recipe, rng):
        samples = (_sample(record, scene, corpus, rng) for record in records)
        yield [s for s in samples if s is not None and normal_form(s.instruction) not in corpus.held_out]


def steps_per_epoch(corpus: Corpus, recipe: Recipe) -> int:
    """Number of steps in a pass."""
    return len(_plan(corpus, recipe, Random(f"{recipe.seed}/0")))


def _plan(corpus: Corpus, recipe: Recipe, rng: Random) -> list[tuple[Scene, list[Record]]]:
    """Deals all records out to steps: those that are bound to the default scene into steps of that scene."""
    count = len(corpus.sentences)
    records = [*corpus.sentences, *_composed(corpus, rng)]
    records += rng.sample(corpus.assistant_requests, int(_ASSISTANT_SHARE * count))
    records += rng.choices(corpus.reference_templates, k=int(_REFERENCE_SHARE * count))
    rng.shuffle(records)
    alone = [record for record in records if _has_own_scene(record)]
    bound = [record for record in records if not _has_own_scene(record) and _is_bound(record, corpus.town)]
    free = [record for record in records if not _has_own_scene(record) and not _is_bound(record, corpus.town)]
    default = Scene(corpus.town, VehicleStatus())
    at_default = max(0, int(recipe.scene_share * len(records)) - len(bound))
    in_default = [*bound, *free[:at_default]]
    rng.shuffle(in_default)
    alone.sort(key=lambda record: str(record.places))  # equal maps beside each other
    plan = [(default, chunk) for chunk in _chunks([*in_default, *alone], recipe.batch_size)]
    plan += [(_scene(corpus, rng), chunk) for chunk in _chunks(free[at_default:], recipe.batch_size)]
    rng.shuffle(plan)
    return plan


def _chunks(records: Sequence[Record], size: int) -> Iterator[list[Record]]:
    for start in range(0, len(records), size):
        yield list(records[start : start + size])


def _has_own_scene(record: Record) -> bool:
    """Whether a record is only true with its own status, or on its own map."""
    if record.status is not None:
        return True
    home = record.places
    return home is not None and not places.is_movable(home, record.instruction, record.program)


def _is_bound(record: Record, town: Sequence[str]) -> bool:
    """Whether a record is only true in the default scene."""
    if record.id.startswith("references-"):
        return bool(places.in_program(town, record.program))
    return (
        _depends_on_status(record)
        or _UNKNOWN_PLACE in record.program
        or not places.is_movable(record.places or town, record.instruction, record.program)
    )


def _scene(corpus: Corpus, rng: Random) -> Scene:
    names = corpus.town if rng.random() < 0.3 else places.random_map(corpus.place_names, rng)
    return Scene(names, scenes.random_status(names, rng))


def _composed(corpus: Corpus, rng: Random) -> list[Record]:
    """Pairs of short sentences, joined."""
    parts = [
        record
        for record in corpus.sentences
        if record.places is None and record.status is None and compose.can_be_part(record.instruction, record.program)
    ]
    composed = []
    for index in range(int(_COMPOSED_SHARE * len(corpus.sentences))):
        one, other = rng.sample(parts, 2)
        joined = compose.join((one.instruction, one.program), (other.instruction, other.program), rng)
        if joined is not None:
            composed.append(
                Record(id=f"composed-{index}", instruction=joined[0], program=joined[1], category=one.category)
            )
    return composed


def _sample(record: Record, scene: Scene, corpus: Corpus, rng: Random) -> Sample | None:
    """A record in a scene, varied; None for a template that makes no sense there."""
    if record.id.startswith("references-"):
        filled = references.fill(record.instruction, record.program, scene.status, rng)
        return None if filled is None else _noisy(Sample(*filled, scene.status, scene.places), rng)
    home = record.places or corpus.town
    if record.status is not None or _depends_on_status(record):
        return _noisy(Sample(record.instruction, record.program, record.status or VehicleStatus(), home), rng)
    return _noisy(_varied(_placed(record, home, scene, corpus, rng), rng), rng)


def _placed(record: Record, home: tuple[str, ...], scene: Scene, corpus: Corpus, rng: Random) -> Sample:
    """The record in a scene; at home, where it would mean something else there."""
    said, program = record.instruction, record.program
    if scene.places == home:
        return Sample(said, program, scene.status, home)
    named = places.mentioned(home, said)
    if not places.is_movable(home, said, program) or _UNKNOWN_PLACE in program or len(named) > len(scene.places):
        return Sample(said, program, VehicleStatus(), home)
    if program.count("action: SET_DESTINATION") == len(named) == 1 and "---" not in program and rng.random() < 0.25:
        return Sample(_lost(said, named[0], scene, corpus, rng), _UNKNOWN_PLACE, scene.status, scene.places)
    return Sample(*places.move(home, scene.places, said, program, rng), scene.status, scene.places)


def _lost(sentence: str, place: str, scene: Scene, corpus: Corpus, rng: Random) -> str:
    """The sentence with a place that isn't on the scene's map, often one that is on others."""
    candidates = corpus.unknown_places if rng.random() < 0.4 else [*corpus.place_names, *corpus.town]
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
