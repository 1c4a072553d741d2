"""Language models: weights, decoding under a constraint, prompts, and the translation of instructions."""

from wayword.models.backend import Completion, InstructionError, LanguageModel, Message
from wayword.models.dataset import DatasetError, Record, read_records
from wayword.models.errors import ModelError
from wayword.models.registry import DEFAULT_MODEL, model_path
from wayword.models.translator import Translation, Translator

__all__ = [
    "DEFAULT_MODEL",
    "Completion",
    "DatasetError",
    "InstructionError",
    "LanguageModel",
    "Message",
    "ModelError",
    "Record",
    "Translation",
    "Translator",
    "model_path",
    "read_records",
]
