"""Language models: weights, decoding under a constraint, prompts, and the translation of instructions."""

from wayword.models.backend import Completion, LanguageModel, Message
from wayword.models.dataset import DatasetError, Record, read_records
from wayword.models.registry import DEFAULT_MODEL, ModelNotFoundError, model_path
from wayword.models.translator import InstructionTooLongError, Translation, Translator

__all__ = [
    "DEFAULT_MODEL",
    "Completion",
    "DatasetError",
    "InstructionTooLongError",
    "LanguageModel",
    "Message",
    "ModelNotFoundError",
    "Record",
    "Translation",
    "Translator",
    "model_path",
    "read_records",
]
