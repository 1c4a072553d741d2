"""What a language model must offer to the translator."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol


class InstructionError(ValueError):
    """An instruction that a model can't read. The message says why."""


@dataclass(frozen=True, slots=True)
class Message:
    """One turn of the conversation that makes up a prompt."""

    role: Literal["system", "user", "assistant"]
    content: str


@dataclass(frozen=True, slots=True)
class Completion:
    """What a model answered.

    Attributes:
        text: The answer.
        tokens: Number of tokens in it.
        forced_tokens: How many of these the constraint determined, so that the model wasn't evaluated for them.
        log_probability: Natural log of the probability that the model, unconstrained, gives to the whole answer, end
            included.
        finished: Whether the model came to an end by itself rather than at the token limit.
    """

    text: str
    tokens: int
    forced_tokens: int
    log_probability: float
    finished: bool


class LanguageModel(Protocol):
    """A model that continues a conversation, if wanted under a grammar."""

    @property
    def name(self) -> str:
        """The model's name, for reports."""
        ...

    def prepare(self, messages: Sequence[Message]) -> None:
        """Reads the constant beginning of prompts ahead of time, so that the completions are faster."""
        ...

    def complete(
        self,
        messages: Sequence[Message],
        *,
        gbnf: str | None = None,
        max_tokens: int = 256,
        temperature: float = 0.0,
        seed: int = 0,
    ) -> Completion:
        """Continues a conversation.

        Args:
            messages: The conversation; the answer is the assistant's next turn.
            gbnf: Grammar that the answer must obey, None for a free answer.
            max_tokens: Where to cut the answer off.
            temperature: 0 takes the most probable token each time.
            seed: For temperatures above 0.
        """
        ...
