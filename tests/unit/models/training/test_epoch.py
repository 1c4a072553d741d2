"""An epoch of training samples: true on its scene, repeatable, apart from every test set."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from importlib.resources import as_file

import pytest

from tests.town import TOWN
from wayword.compiler import VehicleStatus, compile_program
from wayword.models import read_records
from wayword.models.training.augment import places
from wayword.models.training.corpus import Corpus, data_folder
from wayword.models.training.encoding import Sample
from wayword.models.training.epoch import epoch, steps_per_epoch
from wayword.models.training.leakage import leaks, normal_form
from wayword.models.training.recipe import Recipe

RECIPE = Recipe()
HELD_OUT = ("benchmark", "dev", "activation", "attack")


@pytest.fixture(scope="module")
def corpus() -> Iterator[Corpus]:
    yield Corpus(TOWN)
    steps.cache_clear()


@cache
def steps(corpus: Corpus, number: int = 0, *, seed: int = RECIPE.seed, scene_share: float = 0.5) -> list[list[Sample]]:
    return list(epoch(corpus, RECIPE.model_copy(update={"seed": seed, "scene_share": scene_share}), number))


def samples(corpus: Corpus, number: int = 0, *, scene_share: float = 0.5) -> list[Sample]:
    return [sample for step in steps(corpus, number, scene_share=scene_share) for sample in step]


@pytest.fixture(scope="module")
def run(corpus: Corpus) -> list[Sample]:
    """All that the default recipe trains on."""
    return [sample for number in range(RECIPE.epochs) for sample in samples(corpus, number)]


def test_every_sample_compiles_on_its_map(run: list[Sample]) -> None:
    out_of_bounds = 0
    for sample in run:
        result = compile_program(sample.program, sample.places)
        # The model translates, it does not judge bounds (language.md section 4, rule 1).
        assert {diagnostic.code.name for diagnostic in result.diagnostics} <= {"WW0303"}, sample
        if result.ok:
            assert result.canonical == sample.program
        else:
            out_of_bounds += 1
    assert 0 < out_of_bounds < len(run) / 50


def held_out() -> list[str]:
    with as_file(data_folder()) as folder:
        return [r.instruction for name in HELD_OUT for r in read_records(folder / f"{name}.jsonl")]


def test_no_sample_equals_a_sentence_of_a_test_set(run: list[Sample]) -> None:
    forms = {normal_form(instruction) for instruction in held_out()} - {""}  # of texts without Latin letters
    assert len(forms) > 1000
    assert forms.isdisjoint(normal_form(sample.instruction) for sample in run)


def test_augmentation_hardly_ever_comes_near_a_sentence_of_a_test_set(corpus: Corpus) -> None:
    """By chance it may: "How about 5?" is near to "How about you?"."""
    instructions = [sample.instruction for sample in samples(corpus)]
    assert len(leaks(instructions, held_out())) < len(instructions) / 2000


def test_equal_seeds_give_equal_epochs_and_others_others(corpus: Corpus) -> None:
    one = steps(corpus)
    assert steps(Corpus(TOWN)) == one
    assert steps(corpus, 1) != one
    assert steps(corpus, seed=RECIPE.seed + 1) != one


def test_an_epoch_has_the_steps_that_it_says(corpus: Corpus) -> None:
    sizes = [len(step) for step in steps(corpus)]
    assert len(sizes) == steps_per_epoch(corpus, RECIPE)
    assert max(sizes) <= RECIPE.batch_size
    assert sum(sizes) > len(corpus.sentences)


def test_a_place_that_is_rejected_is_not_on_the_map(run: list[Sample]) -> None:
    rejected = [s for s in run if s.program.endswith("value: unknown_place\n") and "---" not in s.program]
    # A sentence may name a known place besides ("not to the library, to the beach"): few do.
    named = sum(bool(places.mentioned(sample.places, sample.instruction)) for sample in rejected)
    assert len(rejected) > 500
    assert named < 0.1 * len(rejected)


def test_scenes_vary(corpus: Corpus) -> None:
    scenes = Counter((sample.places, sample.status.model_dump_json()) for sample in samples(corpus))
    default = scenes[TOWN, VehicleStatus().model_dump_json()]
    assert 0.4 < default / sum(scenes.values()) < 0.75
    assert len({names for names, _ in scenes}) > 50


def test_all_can_take_place_in_the_default_scene(corpus: Corpus) -> None:
    batch = samples(corpus, scene_share=1.0)
    own = sum(r.places is not None or r.status is not None for r in corpus.sentences)
    elsewhere = sum(sample.places != TOWN or sample.status != VehicleStatus() for sample in batch)
    assert elsewhere <= own


def test_epochs_say_most_things_differently(corpus: Corpus) -> None:
    one, other = ({replace_scene(sample) for sample in samples(corpus, number)} for number in (0, 1))
    assert 0.3 < len(one & other) / len(one) < 0.8


def replace_scene(sample: Sample) -> tuple[str, str]:
    """A sample without its scene."""
    bare = replace(sample, places=(), status=VehicleStatus())
    return bare.instruction, bare.program


def test_place_names_are_names_and_differ(corpus: Corpus) -> None:
    for names in (corpus.place_names, corpus.unknown_places):
        assert len({name.lower() for name in names}) == len(names) >= 200
        assert all(name == name.strip() != "" for name in names)
    for name in corpus.place_names:
        source = (
            f"command_type: MISSION\naction: SET_DESTINATION\nparameters:\n  - name: destination\n    value: {name}\n"
        )
        assert compile_program(source).ok, name
