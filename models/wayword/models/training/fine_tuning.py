"""A whole fine-tuning: corpus to adapter."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random

from llama_cpp import Llama

from wayword.compiler import VehicleStatus
from wayword.models.adapter import merged_model
from wayword.models.chat import ChatTokenizer
from wayword.models.dataset import Record, read_records
from wayword.models.datasets import DATA, TEST_SETS
from wayword.models.evaluation.plots import plot_training
from wayword.models.training.corpus import Corpus
from wayword.models.training.encoding import Batch, Encoder, Sample
from wayword.models.training.epoch import epoch, steps_per_epoch
from wayword.models.training.export import read_adapter, write_adapter
from wayword.models.training.leakage import leaks
from wayword.models.training.loop import Run, Step, TrainingError
from wayword.models.training.lora import load_with_adapters
from wayword.models.training.memory import keep_freed_memory
from wayword.models.training.recipe import Recipe
from wayword.models.training.verification import Agreement, compare

_COMPARED_BATCHES = 2


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a fine-tuning.

    Attributes:
        adapter: The adapter, a GGUF file.
        plot: Loss and accuracy over the steps.
        history: All steps.
        steps: Number of steps of the whole run; more than the history has where it was stopped.
        agreement: How near llama.cpp, with adapter merged and quantised, is to torch; None for a stopped run.
    """

    adapter: Path
    plot: Path
    history: Sequence[Step]
    steps: int
    agreement: Agreement | None


def fine_tune(
    base: Path,
    corpus: Corpus,
    dev: Sequence[Record],
    recipe: Recipe,
    folder: Path,
    *,
    start_from: Path | None,
    stop_after_s: float | None,
    on_start: Callable[[Run], None],
    on_step: Callable[[Step], None],
) -> Outcome:
    """Trains, or goes on training, in a folder.

    Args:
        base: GGUF file of the base model.
        corpus: What to train on.
        dev: What to look at meanwhile.
        recipe: The hyperparameters.
        folder: Where checkpoint, adapter and plot live.
        start_from: Adapter to start from, for a further stage; None starts anew.
        stop_after_s: Stop with a checkpoint after so many seconds.
        on_start: Called with the run before its first step.
        on_step: Called after each step.

    Raises:
        TrainingError: The folder's checkpoint is damaged or belongs to another run, or the corpus holds a sentence of
            a test set.
    """
    _refuse_leaks(corpus)
    keep_freed_memory()
    encoder = Encoder(ChatTokenizer(Llama(str(base), vocab_only=True, n_ctx=8, verbose=False)), recipe.structure_share)
    model = load_with_adapters(base, recipe)
    if start_from is not None:
        read_adapter(model, start_from)
    steps = recipe.epochs * steps_per_epoch(corpus, recipe)
    run = Run(folder, model, recipe, steps)
    dev_batches = encoder.batches([_sample(record, corpus.town) for record in dev], Random(recipe.seed))
    on_start(run)
    run.train(
        _steps(corpus, encoder, recipe),
        dev_batches,
        dev_every=max(1, min(100, steps // 10)),
        on_step=on_step,
        stop_after_s=stop_after_s,
    )
    adapter, plot = folder / "adapter.gguf", folder / "loss.png"
    write_adapter(model, recipe, adapter, base.stem)
    measured = {step.step: step.dev_accuracy for step in run.history if step.dev_accuracy is not None}
    plot_training([step.step for step in run.history], [step.loss for step in run.history], measured, plot)
    finished = run.done == steps
    agreement = compare(model, merged_model(base, adapter), dev_batches[:_COMPARED_BATCHES]) if finished else None
    return Outcome(adapter, plot, run.history, steps, agreement)


def _refuse_leaks(corpus: Corpus) -> None:
    """Refuses to train on what is meant for testing, or on what is nearly that."""
    held_out = [record.instruction for name in TEST_SETS for record in read_records(DATA / f"{name}.jsonl")]
    training = [record.instruction for record in (*corpus.sentences, *corpus.assistant_requests)]
    for index, tested in leaks(training, held_out).items():
        raise TrainingError(f"the training sentence {training[index]!r} is too near to {tested!r}, which is for tests")


def _steps(corpus: Corpus, encoder: Encoder, recipe: Recipe) -> Iterator[list[Batch]]:
    rng = Random(f"{recipe.seed}/encoding")
    for number in range(recipe.epochs):
        for samples in epoch(corpus, recipe, number):
            yield encoder.batches(samples, rng)


def _sample(record: Record, town: tuple[str, ...]) -> Sample:
    return Sample(record.instruction, record.program, record.status or VehicleStatus(), record.places or town)
