"""Adapters as GGUF files, which llama.cpp and Wayword read, and back."""

from pathlib import Path

import numpy as np
import torch
from gguf import GGUFType, GGUFValueType, GGUFWriter
from peft import PeftModel, get_peft_model_state_dict, set_peft_model_state_dict

from wayword.models.adapter import FloatArray, adapter_tensors
from wayword.models.errors import ModelError
from wayword.models.training.recipe import Recipe

# transformers' names of the projections and GGUF's.
_NAMES = {
    "self_attn.q_proj": "attn_q",
    "self_attn.k_proj": "attn_k",
    "self_attn.v_proj": "attn_v",
    "self_attn.o_proj": "attn_output",
    "mlp.gate_proj": "ffn_gate",
    "mlp.up_proj": "ffn_up",
    "mlp.down_proj": "ffn_down",
}
_PREFIX = "base_model.model.model.layers."


def write_adapter(model: PeftModel, recipe: Recipe, path: Path, base: str) -> None:
    """Writes the adapter of a model as a GGUF file.

    Rows of the query and key projections are in another order there: llama.cpp rotates neighbouring pairs of rows,
    transformers the two halves of each head.

    Args:
        model: The model with its adapter.
        recipe: What it was trained with; kept in the file.
        path: Where to write.
        base: Name of the base model.
    """
    config = model.get_base_model().config
    heads = {"attn_q": config.num_attention_heads, "attn_k": config.num_key_value_heads}
    writer = GGUFWriter(path, "llama")
    writer.add_type(GGUFType.ADAPTER)
    writer.add_string("general.name", f"Wayword translation adapter for {base}")
    writer.add_string("general.license", "apache-2.0")
    writer.add_string("adapter.type", "lora")
    writer.add_key_value("adapter.lora.alpha", recipe.alpha, GGUFValueType.FLOAT32)
    writer.add_string("wayword.recipe", recipe.model_dump_json())
    for name, tensor in get_peft_model_state_dict(model).items():
        layer, projection, part = _split(name)
        values = tensor.detach().float().numpy()
        if part == "b" and projection in heads:
            values = interleave_halves(values, heads[projection])
        writer.add_tensor(f"blk.{layer}.{projection}.weight.lora_{part}", values.astype(np.float16))
    writer.write_header_to_file()
    writer.write_kv_data_to_file()
    writer.write_tensors_to_file()
    writer.close()


def read_adapter(model: PeftModel, path: Path) -> None:
    """Loads the adapter of a GGUF file into a model, to train it further.

    Raises:
        ModelError: It was trained with another recipe.
    """
    config = model.get_base_model().config
    heads = {"attn_q": config.num_attention_heads, "attn_k": config.num_key_value_heads}
    stored = dict(adapter_tensors(path))
    state = {}
    for name, fresh in get_peft_model_state_dict(model).items():
        layer, projection, part = _split(name)
        values = stored.get(f"blk.{layer}.{projection}.weight.lora_{part}")
        if values is None or values.shape != tuple(fresh.shape):
            raise ModelError(f"{path} was trained with another recipe, its {name} differs; start from another adapter")
        if part == "b" and projection in heads:
            values = separate_halves(values, heads[projection])
        state[name] = torch.from_numpy(np.ascontiguousarray(values))
    set_peft_model_state_dict(model, state)


def interleave_halves(rows: FloatArray, heads: int) -> FloatArray:
    """Reorders rows, shape (heads * d, n), from transformers' to llama.cpp's order within each head."""
    return rows.reshape(heads, 2, rows.shape[0] // heads // 2, -1).swapaxes(1, 2).reshape(rows.shape)


def separate_halves(rows: FloatArray, heads: int) -> FloatArray:
    """The inverse of :func:`interleave_halves`."""
    return rows.reshape(heads, rows.shape[0] // heads // 2, 2, -1).swapaxes(1, 2).reshape(rows.shape)


def _split(name: str) -> tuple[str, str, str]:
    """Layer, GGUF's name of the projection, and "a" or "b", of a peft tensor name."""
    layer, rest = name.removeprefix(_PREFIX).split(".", 1)
    projection, _, part = rest.partition(".lora_")
    return layer, _NAMES[projection], part[0].lower()
