"""The training loop: checkpoints, resume, history."""

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from math import cos, pi
from pathlib import Path
from time import monotonic

import torch
from peft import PeftModel, get_peft_model_state_dict, set_peft_model_state_dict

from wayword.models.training.encoding import Batch
from wayword.models.training.lora import exact_matches, loss_of
from wayword.models.training.recipe import Recipe

CHECKPOINT_EVERY_S = 300.0


class TrainingError(Exception):
    """A run that can't start or go on. The message says what to do."""


@dataclass(frozen=True, slots=True)
class Step:
    """One line of a run's history.

    Attributes:
        step: Number of the step, from 1.
        loss: Mean cross-entropy of the step's targets, in nats per token.
        learning_rate: What the step was taken with.
        dev_accuracy: Share of the development set's programs that the model then wrote exactly; None if not asked.
        seconds: Since the run began, resumed runs added up.
    """

    step: int
    loss: float
    learning_rate: float
    dev_accuracy: float | None
    seconds: float


class Run:
    """A training run in a folder: ``checkpoint.pt`` to resume from and ``history.jsonl``.

    Args:
        folder: Where it lives; if it holds a checkpoint of the same recipe, the run goes on from there.
        model: The model with its adapters.
        recipe: The hyperparameters.
        steps: Number of steps in all.
    """

    def __init__(self, folder: Path, model: PeftModel, recipe: Recipe, steps: int) -> None:
        self.folder = folder
        self.model = model
        self.recipe = recipe
        self.steps = steps
        self.history: list[Step] = []
        self._parameters = [p for p in model.parameters() if p.requires_grad]
        self._optimizer = torch.optim.AdamW(
            self._parameters, lr=recipe.learning_rate, weight_decay=recipe.weight_decay, betas=(0.9, 0.98)
        )
        folder.mkdir(parents=True, exist_ok=True)
        if self._checkpoint.exists():
            self._resume()

    @property
    def done(self) -> int:
        """Number of steps taken."""
        return len(self.history)

    @property
    def _checkpoint(self) -> Path:
        return self.folder / "checkpoint.pt"

    def train(
        self,
        steps: Iterator[Sequence[Batch]],
        dev: Sequence[Batch],
        *,
        dev_every: int,
        on_step: Callable[[Step], None],
        stop_after_s: float | None = None,
    ) -> None:
        """Takes the steps that are left.

        Args:
            steps: The batches of each step of the run, from the first on, the same in each process.
            dev: The development set.
            dev_every: Steps between two looks at it.
            on_step: Called after each step.
            stop_after_s: Stop with a checkpoint after so many seconds.
        """
        started = saved = monotonic()
        before = self.history[-1].seconds if self.history else 0.0
        for number, batches in enumerate(steps, start=1):
            if number <= self.done:
                continue
            rate = self.learning_rate(number)
            loss = self._step(batches, rate)
            looks = number % dev_every == 0 or number == self.steps
            accuracy = self.dev_accuracy(dev) if looks else None
            self.history.append(Step(number, loss, rate, accuracy, before + monotonic() - started))
            on_step(self.history[-1])
            stopping = stop_after_s is not None and monotonic() - started > stop_after_s
            if number == self.steps or stopping or monotonic() - saved > CHECKPOINT_EVERY_S:
                self.save()
                saved = monotonic()
            if stopping:
                return

    def learning_rate(self, step: int) -> float:
        """Linear warm-up, then half a cosine down to a tenth of the peak."""
        warmup = min(self.recipe.warmup_steps, self.steps)
        if step <= warmup:
            return self.recipe.learning_rate * step / warmup
        progress = (step - warmup) / max(1, self.steps - warmup)
        return self.recipe.learning_rate * (0.1 + 0.9 * 0.5 * (1 + cos(pi * progress)))

    def dev_accuracy(self, dev: Sequence[Batch]) -> float:
        """Share of the development set's programs that the model writes exactly."""
        self.model.eval()
        right = sum(exact_matches(self.model, batch) for batch in dev)
        return right / max(1, sum(len(batch.sequences) for batch in dev))

    def save(self) -> None:
        """Writes the checkpoint; a crash in the middle leaves the one before."""
        partial = self._checkpoint.with_suffix(".partial")
        torch.save(
            {
                "recipe": self.recipe.model_dump(),
                "steps": self.steps,
                "adapter": get_peft_model_state_dict(self.model),
                "optimizer": self._optimizer.state_dict(),
                "history": [asdict(step) for step in self.history],
            },
            partial,
        )
        partial.replace(self._checkpoint)
        lines = "".join(json.dumps(asdict(step)) + "\n" for step in self.history)
        (self.folder / "history.jsonl").write_text(lines, encoding="utf-8")

    def _step(self, batches: Sequence[Batch], rate: float) -> float:
        self.model.train()
        for group in self._optimizer.param_groups:
            group["lr"] = rate
        self._optimizer.zero_grad(set_to_none=True)
        targets = sum(len(sequence.targets) for batch in batches for sequence in batch.sequences)
        total = 0.0
        for batch in batches:  # the gradients of a step's batches add up
            loss = loss_of(self.model, batch) / targets
            loss.backward()
            total += float(loss.detach())
        torch.nn.utils.clip_grad_norm_(self._parameters, self.recipe.gradient_clip)
        self._optimizer.step()
        return total

    def _resume(self) -> None:
        try:
            saved = torch.load(self._checkpoint, weights_only=True)
        except Exception as error:  # torch raises half a dozen kinds for a damaged file
            raise TrainingError(f"{self._checkpoint} can't be read ({error}); delete it to start anew") from error
        if (saved["recipe"], saved["steps"]) != (self.recipe.model_dump(), self.steps):
            raise TrainingError(
                f"{self._checkpoint} belongs to a run with another recipe or other data; "
                "delete it or choose another folder with --out"
            )
        set_peft_model_state_dict(self.model, saved["adapter"])
        self._optimizer.load_state_dict(saved["optimizer"])
        self.history = [Step(**step) for step in saved["history"]]
