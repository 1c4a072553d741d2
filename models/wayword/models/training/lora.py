"""The model that is trained: the default GGUF's weights in torch, with LoRA adapters."""

from collections.abc import Sequence
from pathlib import Path

import torch
from peft import LoraConfig, PeftModel, get_peft_model
from torch.nn import functional
from transformers import AutoModelForCausalLM, DynamicCache

from wayword.models.training.encoding import Batch, TokenSequence
from wayword.models.training.recipe import Recipe

# transformers' names of the projections that get an adapter.
PROJECTIONS = ("q_proj", "k_proj", "v_proj", "o_proj", "gate_proj", "up_proj", "down_proj")


def load_with_adapters(path: Path, recipe: Recipe) -> PeftModel:
    """Loads a GGUF file into torch, its weights frozen in bfloat16, with fresh adapters in float32.

    A fresh adapter's product is zero, so that training starts from the model as it is.
    """
    base = AutoModelForCausalLM.from_pretrained(
        path.parent, gguf_file=path.name, dtype=torch.bfloat16, attn_implementation="eager"
    )
    layers = list(range(recipe.frozen_layers, base.config.num_hidden_layers))
    config = LoraConfig(
        r=recipe.rank, lora_alpha=recipe.alpha, target_modules=list(PROJECTIONS), layers_to_transform=layers
    )
    return get_peft_model(base, config)


def target_logits(model: PeftModel, batch: Batch) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    """Evaluates a batch; the head only where the loss counts.

    Returns:
        Logits, shape (targets, vocabulary), float32; the tokens they should predict, shape (targets,); the number of
        the sequence that each belongs to, shape (targets,). Sequences are numbered as in ``batch.sequences``.
    """
    causal = model.get_base_model()
    hidden, wanted, row_of = [], [], []
    with torch.autocast("cpu", torch.bfloat16):
        prefix = DynamicCache()
        if batch.prefix:
            causal.model(input_ids=torch.tensor([batch.prefix]), past_key_values=prefix, use_cache=True)
        first = 0
        for chunk in batch.chunks:
            tokens = _padded(chunk)
            states = causal.model(
                input_ids=tokens, past_key_values=_repeated(prefix, len(chunk)), use_cache=True
            ).last_hidden_state
            row = torch.tensor([number for number, sequence in enumerate(chunk) for _ in sequence.targets])
            position = torch.tensor([target for sequence in chunk for target in sequence.targets])
            hidden.append(states[row, position - 1])
            wanted.append(tokens[row, position])
            row_of.append(row + first)
            first += len(chunk)
        logits = causal.lm_head(torch.cat(hidden))
    return logits.float(), torch.cat(wanted), torch.cat(row_of)


def _padded(chunk: Sequence[TokenSequence]) -> torch.Tensor:
    """The tokens of a chunk, padded on the right, where causal attention never looks."""
    tokens = torch.zeros((len(chunk), max(len(sequence.tokens) for sequence in chunk)), dtype=torch.long)
    for row, sequence in enumerate(chunk):
        tokens[row, : len(sequence.tokens)] = torch.tensor(sequence.tokens)
    return tokens


def _repeated(prefix: DynamicCache, rows: int) -> DynamicCache:
    """Keys and values of the prefix for each of some rows; gradients flow back to the one original."""
    repeated = DynamicCache()
    for number, layer in enumerate(prefix.layers):
        repeated.update(layer.keys.expand(rows, -1, -1, -1), layer.values.expand(rows, -1, -1, -1), number)
    return repeated


def loss_of(model: PeftModel, batch: Batch) -> torch.Tensor:
    """Cross-entropy summed over the batch's targets, in nats."""
    logits, wanted, _ = target_logits(model, batch)
    return functional.cross_entropy(logits, wanted, reduction="sum")


def exact_matches(model: PeftModel, batch: Batch) -> int:
    """How many of the batch's programs the model would write unaided.

    A program is what greedy decoding yields exactly if each of its tokens is the most probable one after those
    before it, so that one evaluation is enough.
    """
    with torch.no_grad():
        logits, wanted, row_of = target_logits(model, batch)
    wrong = set(row_of[logits.argmax(dim=1) != wanted].tolist())
    return len(batch.sequences) - len(wrong)
