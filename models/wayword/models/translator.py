"""Words to programs: the first model stage."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp
from time import perf_counter

from wayword.compiler import VehicleStatus
from wayword.grammar import constraint
from wayword.models.backend import InstructionError, LanguageModel
from wayword.models.prompt import PromptStyle, constant_messages, prompt_messages
from wayword.models.validation import clean, is_text

MAX_INSTRUCTION_CHARACTERS = 1000


@dataclass(frozen=True, slots=True)
class Translation:
    """A program that a model made of an instruction.

    Attributes:
        program: The program's text. Under the constraint it always parses, unless `finished` is False.
        latency_ms: Wall-clock time that it took.
        tokens: Number of tokens in the program.
        forced_tokens: How many of these took no evaluation of the model.
        confidence: Probability that the unconstrained model gives to the whole program, 0 to 1.
        finished: Whether the program is complete rather than cut off at the token limit.
    """

    program: str
    latency_ms: float
    tokens: int
    forced_tokens: int
    confidence: float
    finished: bool


class Translator:
    """Translates instructions for the places of one map.

    Args:
        model: The language model.
        places: Names on the loaded map; the constraint lets no other place through.
        style: The prompt that the model needs.
    """

    def __init__(self, model: LanguageModel, places: Sequence[str], style: PromptStyle = PromptStyle.TUNED) -> None:
        self.model = model
        self.places = tuple(places)
        self.style = style
        self._gbnf = constraint(self.places)

    def prepare(self) -> None:
        """Reads the constant part of the prompt ahead of the first instruction."""
        self.model.prepare(constant_messages(self.places, self.style))

    def translate(
        self,
        instruction: str,
        status: VehicleStatus | None = None,
        *,
        constrained: bool = True,
        temperature: float = 0.0,
        seed: int = 0,
    ) -> Translation:
        """Translates one instruction.

        Args:
            instruction: What the passenger said.
            status: The vehicle's status, None for the default one.
            constrained: Whether the model can only emit programs.
            temperature: 0 takes the most probable token each time.
            seed: For temperatures above 0.

        Raises:
            InstructionError: The instruction has more than 1,000 characters, isn't text, or has nothing to be read.
        """
        if not is_text(instruction):
            raise InstructionError("the instruction isn't UTF-8 text")
        if len(instruction) > MAX_INSTRUCTION_CHARACTERS:
            raise InstructionError(
                f"the instruction has {len(instruction)} characters, at most {MAX_INSTRUCTION_CHARACTERS} are read"
            )
        said = clean(instruction)
        if not said:
            raise InstructionError("the instruction has no visible character")
        started = perf_counter()
        completion = self.model.complete(
            prompt_messages(said, status or VehicleStatus(), self.places, self.style),
            gbnf=self._gbnf if constrained else None,
            temperature=temperature,
            seed=seed,
        )
        return Translation(
            program=completion.text,
            latency_ms=(perf_counter() - started) * 1000,
            tokens=completion.tokens,
            forced_tokens=completion.forced_tokens,
            confidence=exp(completion.log_probability),
            finished=completion.finished,
        )
