"""The model that is trained: the default GGUF's weights in torch, with LoRA adapters."""

from pathlib import Path

import torch
from peft import LoraConfig, PeftModel, get_peft_model
from torch.nn import functional
from transformers import AutoModelForCausalLM, DynamicCache

from wayword.models.training.encoding import Batch
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
        the sequence that each belongs to, shape (targets,).
    """
    causal = model.get_base_model()
    rows = len(batch.sequences)
    width = max(len(sequence.tokens) for sequence in batch.sequences)
    tokens = torch.zeros((rows, width), dtype=torch.long)  # padded on the right, where causal attention never looks
    for row, sequence in enumerate(batch.sequences):
        tokens[row, : len(sequence.tokens)] = torch.tensor(sequence.tokens)
    row_of = torch.tensor([row for row, sequence in enumerate(batch.sequences) for _ in sequence.targets])
    position = torch.tensor([target for sequence in batch.sequences for target in sequence.targets])
    with torch.autocast("cpu", torch.bfloat16):
        cache = DynamicCache()
        if batch.prefix:
            causal.model(input_ids=torch.tensor([batch.prefix]), past_key_values=cache, use_cache=True)
            cache.batch_repeat_interleave(rows)
        hidden = causal.model(input_ids=tokens, past_key_values=cache, use_cache=True).last_hidden_state
        logits = causal.lm_head(hidden[row_of, position - 1])
    return logits.float(), tokens[row_of, position], row_of


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
