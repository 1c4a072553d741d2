"""Whether the adapter, written as GGUF, merged and quantised, is still the model that was trained."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from llama_cpp import Llama
from peft import PeftModel

from wayword.models.training.encoding import Batch
from wayword.models.training.lora import target_logits

_CONTEXT_TOKENS = 1024


@dataclass(frozen=True, slots=True)
class Agreement:
    """How near llama.cpp's logits are to torch's.

    Attributes:
        tokens: Number of positions compared.
        same_argmax: Share of them with the same most probable token.
        mean_difference: Mean absolute difference of log-probabilities of the tokens that should follow, in nats.
    """

    tokens: int
    same_argmax: float
    mean_difference: float


def compare(model: PeftModel, merged: Path, batches: Sequence[Batch]) -> Agreement:
    """Evaluates the same tokens with torch and with llama.cpp.

    Args:
        model: The trained model.
        merged: GGUF file of the base model with the adapter merged in.
        batches: What to evaluate.
    """
    model.eval()
    llama = Llama(str(merged), n_ctx=_CONTEXT_TOKENS, logits_all=True, verbose=False)
    same: list[bool] = []
    differences: list[float] = []
    for batch in batches:
        with torch.no_grad():
            ours, wanted, row_of = target_logits(model, batch)
        ours = torch.log_softmax(ours, dim=1)
        for row, sequence in enumerate(batch.sequences):
            chosen = row_of == row
            theirs = torch.log_softmax(_llama_logits(llama, batch.prefix, sequence.tokens, sequence.targets), dim=1)
            same += (ours[chosen].argmax(dim=1) == theirs.argmax(dim=1)).tolist()
            tokens = wanted[chosen].unsqueeze(1)
            differences += (ours[chosen].gather(1, tokens) - theirs.gather(1, tokens)).abs().flatten().tolist()
    return Agreement(len(same), float(np.mean(same)), float(np.mean(differences)))


def _llama_logits(llama: Llama, prefix: list[int], tokens: list[int], targets: list[int]) -> torch.Tensor:
    llama.n_tokens = 0  # from the start
    llama.eval([*prefix, *tokens])
    positions = [len(prefix) + target - 1 for target in targets]
    return torch.from_numpy(np.array(llama.scores[positions]))
