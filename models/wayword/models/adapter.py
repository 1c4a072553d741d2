"""LoRA adapters: what fine-tuning adds to a base model, merged into it once and kept in the user's cache."""

import hashlib
import os
from collections.abc import Iterator
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

import numpy as np
from gguf import GGMLQuantizationType, GGUFReader, GGUFValueType, GGUFWriter, LlamaFileType, ReaderField
from gguf.quants import dequantize, quantize
from numpy.typing import NDArray
from platformdirs import user_cache_path

from wayword.models.errors import ModelError

# Chosen by accuracy first: requantised to Q4_0, which is faster, a first adapter lost six points; to Q8_0 none.
_QUANTIZATION = GGMLQuantizationType.Q8_0
# Raised when merging the same files would give other weights.
_MERGE_VERSION = 1

_OTHER = "give the model that it was trained on, or another adapter"

FloatArray = NDArray[np.float32]


def merged_model(base: Path, adapter: Path) -> Path:
    """Merges an adapter into a base model, the first time that this pair is asked for.

    The result is kept in the user's cache (``WAYWORD_CACHE``, if set, names another folder): some 150 MB for the
    default model, made in some seconds.

    Args:
        base: GGUF file of the model that the adapter was trained on.
        adapter: GGUF file of the LoRA adapter.

    Raises:
        ModelError: A file can't be read or written, or the two don't belong together.
    """
    merged = _merged_path(base, adapter)
    if _exists(merged):
        return merged
    try:
        merged.parent.mkdir(parents=True, exist_ok=True)
        with NamedTemporaryFile(dir=merged.parent, suffix=".partial", delete=False) as partial:
            pass
        try:
            _merge(base, adapter, Path(partial.name))
            Path(partial.name).replace(merged)  # whoever reads it sees all of it or nothing
        finally:
            Path(partial.name).unlink(missing_ok=True)
    except OSError as error:
        raise ModelError(
            f"can't write the merged model to {merged.parent}: {error.strerror}; name another folder in WAYWORD_CACHE"
        ) from error
    return merged


def is_cached(base: Path, adapter: Path) -> bool:
    """Whether the merged model is there already."""
    return _exists(_merged_path(base, adapter))


def check_adapter(path: Path) -> None:
    """Makes sure that a file is a LoRA adapter.

    Raises:
        ModelError: It is none.
    """
    _Deltas(_read(path), path)


def _merged_path(base: Path, adapter: Path) -> Path:
    named = os.environ.get("WAYWORD_CACHE")
    folder = Path(named).expanduser() if named else user_cache_path("wayword")
    try:
        file = base.stat()  # by name, size and time, as make tells files apart: reading all of it would take too long
        named_base = f"{base.name} {file.st_size} {file.st_mtime_ns}"
        digest = hashlib.sha256(f"{_MERGE_VERSION} {_QUANTIZATION.name} {named_base} ".encode())
        digest.update(adapter.read_bytes())
    except OSError as error:
        raise ModelError(f"can't read {error.filename}: {error.strerror}; give the path of a GGUF file") from error
    return folder / f"{adapter.stem}-{digest.hexdigest()[:16]}.gguf"


def _exists(path: Path) -> bool:
    try:
        return path.exists()
    except OSError:  # a folder that can't be looked into; writing to it will say why
        return False


def _merge(base: Path, adapter: Path, target: Path) -> None:
    model, deltas = _read(base), _Deltas(_read(adapter), adapter)
    architecture = model.get_field("general.architecture")
    if architecture is None:
        raise ModelError(f"{base} is no complete GGUF file: it has no general.architecture; download it anew")
    writer = GGUFWriter(target, str(architecture.contents()))
    for field in model.fields.values():
        if not field.name.startswith("GGUF.") and field.name != "general.architecture":
            _copy(field, writer)
    writer.add_file_type(LlamaFileType.MOSTLY_Q8_0)
    for tensor in model.tensors:
        weights = dequantize(tensor.data, tensor.tensor_type).astype(np.float32)
        delta = deltas.pop(tensor.name, weights.shape)
        merged = weights if delta is None else weights + delta
        if tensor.tensor_type == GGMLQuantizationType.F32:
            writer.add_tensor(tensor.name, merged)
        elif delta is None and tensor.tensor_type == _QUANTIZATION:
            writer.add_tensor(tensor.name, tensor.data, raw_dtype=tensor.tensor_type)
        else:
            writer.add_tensor(tensor.name, quantize(merged, _QUANTIZATION), raw_dtype=_QUANTIZATION)
    deltas.check_all_used(base)
    writer.write_header_to_file()
    writer.write_kv_data_to_file()
    writer.write_tensors_to_file()
    writer.close()


class _Deltas:
    """The products alpha / rank * B A of an adapter, by the name of the tensor that they are added to."""

    def __init__(self, adapter: GGUFReader, path: Path) -> None:
        alpha = adapter.get_field("adapter.lora.alpha")
        if alpha is None:
            raise ModelError(
                f"{path} is no LoRA adapter: it has no adapter.lora.alpha; give the file that `wayword train` made"
            )
        self._path = path
        self._alpha = float(alpha.contents())
        self._parts = {tensor.name: dequantize(tensor.data, tensor.tensor_type) for tensor in adapter.tensors}

    def pop(self, name: str, shape: tuple[int, ...]) -> FloatArray | None:
        """The change of a tensor, shape (outputs, inputs), None where it stays as it is."""
        a, b = self._parts.pop(f"{name}.lora_a", None), self._parts.pop(f"{name}.lora_b", None)
        if a is None and b is None:
            return None
        if a is None or b is None:
            raise ModelError(f"{self._path} is incomplete: it has one of two matrices for {name}; download it anew")
        if a.ndim != 2 or b.ndim != 2 or (b.shape[0], a.shape[1]) != shape or a.shape[0] != b.shape[1]:
            raise ModelError(
                f"{self._path} doesn't fit the base model: {name} is {shape}, its matrices {b.shape} {a.shape}; "
                f"{_OTHER}"
            )
        delta: FloatArray = (self._alpha / a.shape[0]) * (b.astype(np.float32) @ a.astype(np.float32))
        return delta

    def check_all_used(self, base: Path) -> None:
        """Refuses an adapter with parts that the base model has no place for."""
        if self._parts:
            raise ModelError(
                f"{self._path} doesn't belong to {base.name}, which has no {next(iter(self._parts))}; {_OTHER}"
            )


def _read(path: Path) -> GGUFReader:
    try:
        return GGUFReader(path)
    except (ValueError, IndexError, KeyError) as error:
        raise ModelError(f"{path} is no complete GGUF file: {error}; download or make it anew") from error


def _copy(field: ReaderField, writer: GGUFWriter) -> None:
    value: Any = field.contents()
    inner = field.types[-1] if field.types[0] == GGUFValueType.ARRAY else None
    if field.name in ("general.file_type", "general.alignment"):
        return  # the writer's own
    if value != []:  # it can't write empty arrays
        writer.add_key_value(field.name, value, field.types[0], inner)


def adapter_tensors(path: Path) -> Iterator[tuple[str, FloatArray]]:
    """The matrices of an adapter, by GGUF name."""
    for tensor in _read(path).tensors:
        yield tensor.name, dequantize(tensor.data, tensor.tensor_type).astype(np.float32)
