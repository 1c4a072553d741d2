"""The recipe end to end on a small slice: `make train-smoke`."""

import json
from pathlib import Path

import pytest

from tests.town import TOWN
from wayword.models import Record, Translator, model_path, read_records
from wayword.models.adapter import merged_model
from wayword.models.datasets import shipped_data
from wayword.models.embedded import EmbeddedModel

pytest.importorskip("torch")
pytest.importorskip("peft")

from wayword.models.training.corpus import Corpus
from wayword.models.training.fine_tuning import Outcome, fine_tune
from wayword.models.training.loop import Run, Step, TrainingError
from wayword.models.training.recipe import Recipe

pytestmark = pytest.mark.train

RECIPE = Recipe(epochs=2, batch_size=16, warmup_steps=2, learning_rate=2e-3)


def dev() -> list[Record]:
    path = shipped_data("dev")
    assert path is not None
    return list(read_records(path))[::25]


def train(folder: Path, *, recipe: Recipe = RECIPE, stop_after_s: float | None = None) -> Outcome:
    def on_start(run: Run) -> None:
        assert run.steps > 0

    def on_step(step: Step) -> None:
        print(step)  # noqa: T201 - shown where the test fails

    corpus = Corpus(TOWN, sentences=48)
    return fine_tune(
        model_path(), corpus, dev(), recipe, folder,
        start_from=None, stop_after_s=stop_after_s, on_start=on_start, on_step=on_step,
    )  # fmt: skip


@pytest.fixture(scope="module")
def outcome(tmp_path_factory: pytest.TempPathFactory) -> Outcome:
    return train(tmp_path_factory.mktemp("whole"))


def test_the_loss_falls(outcome: Outcome) -> None:
    losses = [step.loss for step in outcome.history]
    assert len(losses) == outcome.steps
    assert losses[-1] < 0.7 * losses[0]


def test_llama_cpp_with_the_adapter_merged_in_agrees_with_torch(outcome: Outcome) -> None:
    assert outcome.agreement is not None
    assert outcome.agreement.tokens > 100
    assert outcome.agreement.same_argmax > 0.95
    assert outcome.agreement.mean_difference < 0.2


def test_the_adapter_translates(outcome: Outcome) -> None:
    translator = Translator(EmbeddedModel(merged_model(model_path(), outcome.adapter)), TOWN)
    translation = translator.translate("Take me to the museum.")
    assert translation.finished
    assert translation.program.startswith("command_type: ")


def test_the_run_leaves_a_plot_and_its_history(outcome: Outcome) -> None:
    assert outcome.plot.read_bytes().startswith(b"\x89PNG")
    history = outcome.adapter.with_name("history.jsonl").read_text().splitlines()
    assert [json.loads(line)["step"] for line in history] == [step.step for step in outcome.history]


def test_an_interrupted_run_ends_like_an_uninterrupted_one(outcome: Outcome, tmp_path: Path) -> None:
    first = train(tmp_path, stop_after_s=1.0)
    assert len(first.history) < first.steps
    assert first.agreement is None
    resumed = train(tmp_path)
    assert [step.loss for step in resumed.history] == pytest.approx([step.loss for step in outcome.history], rel=0.02)


def test_a_run_of_another_recipe_or_a_damaged_checkpoint_is_refused(outcome: Outcome, tmp_path: Path) -> None:
    with pytest.raises(TrainingError, match="another recipe"):
        train(outcome.adapter.parent, recipe=RECIPE.model_copy(update={"alpha": 1.0}))
    (tmp_path / "checkpoint.pt").write_bytes(b"nonsense")
    with pytest.raises(TrainingError, match="delete it"):
        train(tmp_path)
