"""``wayword train``: fine-tuning of the translation model."""

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click
from pydantic import ValidationError
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from wayword.cli.common import errors, fail, friendly_errors, json_option, make_folder, print_json
from wayword.models import DatasetError, ModelError, adapter_path, model_path, read_records
from wayword.models.adapter import check_adapter
from wayword.models.datasets import shipped_data
from wayword.models.training.recipe import Recipe
from wayword.models.validation import explain
from wayword.runtime.world import load_map

if TYPE_CHECKING:
    from wayword.models.training.fine_tuning import Outcome
    from wayword.models.training.loop import Run, Step


@click.command()
@click.option("--out", type=click.Path(path_type=Path), default=Path("out/train"), show_default=True)
@click.option("--epochs", type=click.IntRange(min=1), help="Passes over the corpus (default: the recipe's).")
@click.option("--learning-rate", type=click.FloatRange(min=0, min_open=True), help="Default: the recipe's.")
@click.option("--sentences", type=click.IntRange(min=1), help="Train on so many sentences only, chosen at random.")
@click.option("--from", "start_from", help="Adapter (GGUF) to start from, or: shipped. For a further stage.")
@click.option("--minutes", type=click.FloatRange(min=0, min_open=True), help="Stop after so long; call again to go on.")
@click.option("--seed", type=int, default=0, show_default=True)
@json_option
@friendly_errors(ModelError, DatasetError)
def train(
    out: Path,
    epochs: int | None,
    learning_rate: float | None,
    sentences: int | None,
    start_from: str | None,
    minutes: float | None,
    seed: int,
    as_json: bool,
) -> None:
    """Fine-tune the embedded model on the corpus that ships with Wayword: LoRA, on the CPU.

    The run lives in a folder; called again with the same options it goes on from its last checkpoint, made every five
    minutes. The result, adapter.gguf, is used with --adapter out/train/adapter.gguf. Needs the extra train:
    pip install 'wayword[train]'.

    \b
    Examples:
      wayword train                              three passes: some two hours on two cores
      wayword train --minutes 30                 half an hour of it; again to go on
      wayword train --sentences 200 --epochs 1   a small slice, to see that it works
    """
    chosen = {"epochs": epochs, "learning_rate": learning_rate, "seed": seed}
    try:
        recipe = Recipe.model_validate({name: value for name, value in chosen.items() if value is not None})
    except ValidationError as error:
        fail(explain(error, Recipe), as_json=as_json)
    start = None if start_from is None else adapter_path(None, None if start_from == "shipped" else start_from)
    if start is not None:
        check_adapter(start)
    make_folder(out)
    missing = [name for name in ("torch", "transformers", "peft") if find_spec(name) is None]
    if missing:
        fail(f"{', '.join(missing)} not installed; fine-tuning needs: pip install 'wayword[train]'", as_json=as_json)
    from wayword.models.training.corpus import Corpus
    from wayword.models.training.fine_tuning import fine_tune
    from wayword.models.training.loop import TrainingError

    dev = shipped_data("dev")
    assert dev is not None
    display = _Display()
    try:
        with display.bar:
            outcome = fine_tune(
                model_path(),
                Corpus(load_map("town").place_names, sentences=sentences),
                list(read_records(dev)),
                recipe,
                out,
                start_from=start,
                stop_after_s=None if minutes is None else 60 * minutes,
                on_start=display.start,
                on_step=display.step,
            )
    except TrainingError as error:
        fail(str(error), as_json=as_json)
    if as_json:
        print_json(_report(outcome))
    else:
        _show(outcome)


class _Display:
    """The progress bar of a run."""

    def __init__(self) -> None:
        columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
        times = (TimeElapsedColumn(), TimeRemainingColumn(elapsed_when_finished=True))
        self.bar = Progress(*columns, *times, TextColumn("{task.fields[note]}"), console=errors)
        self._task = self.bar.add_task("loading the model", total=None, note="")
        self._accuracy = ""

    def start(self, run: "Run") -> None:
        self.bar.update(self._task, description="training", total=run.steps, completed=run.done)

    def step(self, step: "Step") -> None:
        if step.dev_accuracy is not None:
            self._accuracy = f", dev {100 * step.dev_accuracy:.1f} %"
        self.bar.update(self._task, advance=1, note=f"loss {step.loss:.3f}{self._accuracy}")


def _report(outcome: "Outcome") -> dict[str, object]:
    last = outcome.history[-1]
    return {
        "adapter": str(outcome.adapter),
        "steps": outcome.steps,
        "steps_done": last.step,
        "loss": round(last.loss, 4),
        "dev_accuracy": last.dev_accuracy,
        "seconds": round(last.seconds, 1),
        "llama_cpp_same_argmax": outcome.agreement and round(outcome.agreement.same_argmax, 4),
        "llama_cpp_mean_difference_nats": outcome.agreement and round(outcome.agreement.mean_difference, 4),
    }


def _show(outcome: "Outcome") -> None:
    last = outcome.history[-1]
    if last.step < outcome.steps:
        errors.print(f"stopped after {last.step} of {outcome.steps} steps; call again with the same options to go on")
    if outcome.agreement is not None:
        errors.print(
            f"llama.cpp, with the adapter merged in and quantised, has the same most probable token as torch in "
            f"{100 * outcome.agreement.same_argmax:.1f} % of {outcome.agreement.tokens} places"
        )
    click.echo(f"adapter in {outcome.adapter}, plot in {outcome.plot}")
