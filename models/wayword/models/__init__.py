"""Language models: weights, decoding under a constraint, prompts, and the translation of instructions."""

from wayword.models.backend import Completion, InstructionError, LanguageModel, Message
from wayword.models.dataset import DatasetError, Record, read_records
from wayword.models.errors import ModelError
from wayword.models.prompt import PromptStyle
from wayword.models.registry import DEFAULT_MODEL, Weights, adapter_path, find_weights, model_path
from wayword.models.translator import Translation, Translator

__all__ = [
    "DEFAULT_MODEL",
    "Completion",
    "DatasetError",
    "InstructionError",
    "LanguageModel",
    "Message",
    "ModelError",
    "PromptStyle",
    "Record",
    "Translation",
    "Translator",
    "Weights",
    "adapter_path",
    "find_weights",
    "model_path",
    "read_records",
]
