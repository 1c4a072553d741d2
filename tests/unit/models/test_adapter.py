"""Adapters merged into tiny models: the right weights, once, whole files only, and errors that help."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from gguf import GGMLQuantizationType, GGUFReader, GGUFValueType, GGUFWriter
from gguf.quants import dequantize, quantize

from wayword.models import ModelError, model_path
from wayword.models.adapter import FloatArray, adapter_tensors, check_adapter, is_cached, merged_model

QUERY, OUTPUT, NORM = "blk.0.attn_q.weight", "blk.0.attn_output.weight", "blk.0.attn_norm.weight"
KEPT, HALF = "blk.0.ffn_up.weight", "blk.0.ffn_down.weight"
RANK, ALPHA = 4, 8.0
F32, F16, Q4_0, Q8_0 = (GGMLQuantizationType[name] for name in ("F32", "F16", "Q4_0", "Q8_0"))

Tensors = Mapping[str, tuple[FloatArray, GGMLQuantizationType]]


def matrix(seed: int, *shape: int) -> FloatArray:
    return np.random.default_rng(seed).normal(size=shape).astype(np.float32)


BASE: Tensors = {
    QUERY: (matrix(1, 64, 32), F32),
    OUTPUT: (matrix(2, 32, 64), Q4_0),
    KEPT: (matrix(3, 96, 32), Q8_0),
    HALF: (matrix(4, 32, 96), F16),
    NORM: (matrix(5, 32), F32),
}
ADAPTER: Tensors = {
    f"{QUERY}.lora_a": (matrix(11, RANK, 32), F16),
    f"{QUERY}.lora_b": (matrix(12, 64, RANK), F16),
    f"{OUTPUT}.lora_a": (matrix(13, RANK, 64), F32),
    f"{OUTPUT}.lora_b": (matrix(14, 32, RANK), F32),
}


def add_tensors(writer: GGUFWriter, tensors: Tensors) -> None:
    for name, (values, kind) in tensors.items():
        if kind in (F32, F16):
            writer.add_tensor(name, values.astype(np.float32 if kind is F32 else np.float16))
        else:
            writer.add_tensor(name, quantize(values, kind), raw_dtype=kind)
    writer.write_header_to_file()
    writer.write_kv_data_to_file()
    writer.write_tensors_to_file()
    writer.close()


def write_base(path: Path, tensors: Tensors = BASE) -> Path:
    writer = GGUFWriter(path, "llama")
    writer.add_string("general.name", "Tiny – größer")
    writer.add_custom_alignment(128)
    writer.add_file_type(2)
    writer.add_uint32("llama.block_count", 1)
    writer.add_float32("llama.rope.freq_base", 10000.5)
    writer.add_bool("tokenizer.ggml.add_bos_token", False)
    writer.add_array("tokenizer.ggml.tokens", ["<|im_start|>", "Ġgo", "停", ""])
    writer.add_array("tokenizer.ggml.token_type", [3, 1, 1, 1])
    writer.add_array("tokenizer.ggml.scores", [0.5, -1.5])
    add_tensors(writer, tensors)
    return path


def write_adapter(path: Path, tensors: Tensors = ADAPTER, alpha: float | None = ALPHA) -> Path:
    path.parent.mkdir(exist_ok=True)
    writer = GGUFWriter(path, "llama")
    writer.add_string("adapter.type", "lora")
    if alpha is not None:
        writer.add_key_value("adapter.lora.alpha", alpha, GGUFValueType.FLOAT32)
    add_tensors(writer, tensors)
    return path


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "cache" / "not yet there"
    monkeypatch.setenv("WAYWORD_CACHE", str(folder))
    return folder


@pytest.fixture
def base(tmp_path: Path) -> Path:
    return write_base(tmp_path / "tiny.gguf")


@pytest.fixture
def adapter(tmp_path: Path) -> Path:
    return write_adapter(tmp_path / "lora.gguf")


def weights(path: Path) -> dict[str, FloatArray]:
    return {t.name: dequantize(t.data, t.tensor_type).astype(np.float32) for t in GGUFReader(path).tensors}


def kinds(path: Path) -> dict[str, GGMLQuantizationType]:
    return {tensor.name: tensor.tensor_type for tensor in GGUFReader(path).tensors}


def rounding(values: FloatArray) -> FloatArray:
    """Half a step of Q8_0 for each value: blocks of 32 share a scale, a 127th of their greatest, stored as float16."""
    blocks = np.abs(values).reshape(-1, 32).max(axis=1)
    return np.asarray(
        np.repeat(blocks / 127 * 0.5 + blocks * 2.0**-11, 32).reshape(values.shape) + 1e-6, dtype=np.float32
    )


# What is merged


@pytest.mark.usefixtures("cache")
def test_merged_weights_are_the_base_and_the_scaled_product(base: Path, adapter: Path) -> None:
    before, after, parts = weights(base), weights(merged_model(base, adapter)), weights(adapter)
    for name in (QUERY, OUTPUT):
        expected = before[name] + ALPHA / RANK * (parts[f"{name}.lora_b"] @ parts[f"{name}.lora_a"])
        assert np.all(np.abs(after[name] - expected) <= rounding(expected))
        assert not np.allclose(after[name], before[name], atol=0.1)


@pytest.mark.usefixtures("cache")
def test_other_weights_stay_as_they_are(base: Path, adapter: Path) -> None:
    before, merged = weights(base), merged_model(base, adapter)
    after = weights(merged)
    assert list(after) == list(before)
    assert np.array_equal(after[KEPT], before[KEPT])
    assert np.array_equal(after[NORM], before[NORM])
    assert np.all(np.abs(after[HALF] - before[HALF]) <= rounding(before[HALF]))
    assert kinds(merged) == {QUERY: F32, OUTPUT: Q8_0, KEPT: Q8_0, HALF: Q8_0, NORM: F32}


@pytest.mark.usefixtures("cache")
def test_an_adapter_without_matrices_changes_nothing(base: Path, tmp_path: Path) -> None:
    zeros: Tensors = {name: (np.zeros_like(values), kind) for name, (values, kind) in ADAPTER.items()}
    merged = merged_model(base, write_adapter(tmp_path / "zero.gguf", zeros))
    assert np.array_equal(weights(merged)[QUERY], weights(base)[QUERY])


@pytest.mark.usefixtures("cache")
def test_metadata_are_copied_but_for_those_of_the_file_itself(base: Path, adapter: Path) -> None:
    before, after = (GGUFReader(path).fields for path in (base, merged_model(base, adapter)))
    own = {"general.file_type", "general.alignment"}
    for name in before.keys() - own:
        if not name.startswith("GGUF."):
            assert after[name].contents() == before[name].contents(), name
            assert after[name].types == before[name].types, name
    assert after["tokenizer.ggml.tokens"].contents() == ["<|im_start|>", "Ġgo", "停", ""]
    assert after["general.file_type"].contents() == 7  # mostly Q8_0
    assert "adapter.lora.alpha" not in after


def test_the_parts_of_an_adapter(adapter: Path) -> None:
    assert [name for name, _ in adapter_tensors(adapter)] == list(ADAPTER)
    assert all(values.dtype == np.float32 for _, values in adapter_tensors(adapter))
    check_adapter(adapter)


# The cache


def test_the_merged_model_is_kept_where_the_user_says(cache: Path, base: Path, adapter: Path) -> None:
    assert not is_cached(base, adapter)
    merged = merged_model(base, adapter)
    assert merged.parent == cache
    assert list(cache.iterdir()) == [merged]
    assert is_cached(base, adapter)


def test_it_is_made_once(cache: Path, base: Path, adapter: Path) -> None:
    merged = merged_model(base, adapter)
    merged.write_bytes(b"the first one")
    assert merged_model(base, adapter) == merged
    assert merged.read_bytes() == b"the first one"
    assert list(cache.iterdir()) == [merged]


@pytest.mark.usefixtures("cache")
def test_merging_is_reproducible(base: Path, adapter: Path) -> None:
    merged = merged_model(base, adapter)
    content = merged.read_bytes()
    merged.unlink()
    assert merged_model(base, adapter).read_bytes() == content


def test_another_adapter_or_another_base_gives_another_file(
    cache: Path, tmp_path: Path, base: Path, adapter: Path
) -> None:
    merged = merged_model(base, adapter)
    assert merged_model(base, write_adapter(tmp_path / "other" / "lora.gguf", alpha=9.0)) != merged
    assert merged_model(write_base(tmp_path / "tiny2.gguf"), adapter) != merged
    assert len(list(cache.iterdir())) == 3


def test_the_tilde_is_the_home_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, base: Path, adapter: Path
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("WAYWORD_CACHE", "~/mine")
    assert merged_model(base, adapter).parent == tmp_path / "mine"


# What doesn't fit


def without(tensors: Tensors, *names: str) -> Tensors:
    return {name: tensor for name, tensor in tensors.items() if name not in names}


BAD: Mapping[str, tuple[Tensors, float | None, str]] = {
    "no LoRA": (ADAPTER, None, r"no LoRA adapter: .*adapter\.lora\.alpha; give the file that `wayword train` made"),
    "another tensor": (
        {**ADAPTER, "blk.7.attn_q.weight.lora_a": (matrix(1, RANK, 32), F32)},
        ALPHA,
        r"doesn't belong to tiny\.gguf, which has no blk\.7.*; give the model that it was trained on",
    ),
    "another width": (
        {**ADAPTER, f"{QUERY}.lora_a": (matrix(1, RANK, 48), F32)},
        ALPHA,
        r"doesn't fit the base model: blk\.0\.attn_q\.weight is \(64, 32\).*; give the model that it was trained on",
    ),
    "another rank": ({**ADAPTER, f"{QUERY}.lora_a": (matrix(1, 2, 32), F32)}, ALPHA, "doesn't fit the base model"),
    "no matrix": ({**ADAPTER, f"{QUERY}.lora_a": (matrix(1, 32), F32)}, ALPHA, "doesn't fit the base model"),
    "one half": (without(ADAPTER, f"{QUERY}.lora_b"), ALPHA, r"incomplete.*attn_q.*; download it anew"),
}


@pytest.mark.parametrize(("tensors", "alpha", "message"), BAD.values(), ids=BAD)
def test_an_adapter_that_does_not_fit_is_refused_and_leaves_nothing(
    cache: Path, tmp_path: Path, base: Path, tensors: Tensors, alpha: float | None, message: str
) -> None:
    bad = write_adapter(tmp_path / "bad.gguf", tensors, alpha)
    with pytest.raises(ModelError, match=message):
        merged_model(base, bad)
    assert list(cache.iterdir()) == []
    assert not is_cached(base, bad)


def test_an_adapter_is_checked_without_its_base(tmp_path: Path, base: Path) -> None:
    with pytest.raises(ModelError, match="no LoRA adapter"):
        check_adapter(base)
    (tmp_path / "cut.gguf").write_bytes(base.read_bytes()[:40])
    with pytest.raises(ModelError, match=r"cut\.gguf is no complete GGUF file.*; download or make it anew"):
        check_adapter(tmp_path / "cut.gguf")


@pytest.mark.parametrize("share", [0.02, 0.3, 0.99])
def test_a_file_cut_off_is_refused_and_leaves_nothing(cache: Path, base: Path, adapter: Path, share: float) -> None:
    content = base.read_bytes()
    base.write_bytes(content[: int(share * len(content))])
    with pytest.raises(ModelError, match=r"tiny\.gguf is no complete GGUF file"):
        merged_model(base, adapter)
    assert list(cache.iterdir()) == []


@pytest.mark.usefixtures("cache")
def test_a_missing_file_is_named(tmp_path: Path, base: Path, adapter: Path) -> None:
    with pytest.raises(ModelError, match=r"can't read .*none\.gguf: No such file"):
        merged_model(base, tmp_path / "none.gguf")
    with pytest.raises(ModelError, match=r"can't read .*none\.gguf: No such file"):
        merged_model(tmp_path / "none.gguf", adapter)


@pytest.mark.parametrize("folder", ["file", "file/below", "x" * 300])
def test_a_folder_that_cannot_be_written_to_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, base: Path, adapter: Path, folder: str
) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv("WAYWORD_CACHE", str(tmp_path / folder))
    before = sorted(tmp_path.iterdir())
    assert not is_cached(base, adapter)
    with pytest.raises(ModelError, match=r"can't write the merged model to .*name another folder in WAYWORD_CACHE"):
        merged_model(base, adapter)
    assert sorted(tmp_path.iterdir()) == before


def test_a_full_disk_leaves_no_partial_file(
    cache: Path, monkeypatch: pytest.MonkeyPatch, base: Path, adapter: Path
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(GGUFWriter, "write_tensors_to_file", full)
    with pytest.raises(ModelError, match="No space left on device; name another folder"):
        merged_model(base, adapter)
    assert list(cache.iterdir()) == []


def test_the_embedded_model_itself_is_no_adapter() -> None:
    with pytest.raises(ModelError, match="no LoRA adapter"):
        check_adapter(model_path())


# Rows of query and key projections


def test_interleaving_and_separating_halves_are_inverse() -> None:
    pytest.importorskip("torch")
    pytest.importorskip("peft")
    from wayword.models.training.export import interleave_halves, separate_halves

    for heads, size, columns in ((1, 2, 1), (3, 8, 5), (9, 64, 16)):
        rows = matrix(0, heads * size, columns)
        mixed = interleave_halves(rows, heads)
        assert mixed.shape == rows.shape
        assert np.array_equal(separate_halves(mixed, heads), rows)
        assert np.array_equal(interleave_halves(separate_halves(rows, heads), heads), rows)


def test_interleaving_pairs_each_row_with_that_of_the_other_half() -> None:
    pytest.importorskip("torch")
    pytest.importorskip("peft")
    from wayword.models.training.export import interleave_halves

    rows: FloatArray = np.arange(12, dtype=np.float32)[:, None]  # two heads of six
    assert interleave_halves(rows, 2)[:, 0].tolist() == [0, 3, 1, 4, 2, 5, 6, 9, 7, 10, 8, 11]
