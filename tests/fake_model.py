"""A language model that says what the test has it say."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import log

from tests.programs import program
from wayword.models import Completion, Message

REFUSAL = program("REJECT", reason="unrelated")


@dataclass(frozen=True)
class Answer:
    """What the model says, and how sure it is of it."""

    text: str
    confidence: float = 0.99
    finished: bool = True


class FakeModel:
    """Gives the scripted answer to an instruction, to any other one that it is out of scope.

    Attributes:
        asked: The instructions, in order.
        constrained: For each, whether there was a grammar.
        prompts: For each, the whole prompt.
    """

    def __init__(self, answers: Mapping[str, Answer | str] | None = None, name: str = "fake") -> None:
        self._answers = answers or {}
        self._name = name
        self.asked: list[str] = []
        self.constrained: list[bool] = []
        self.prompts: list[tuple[Message, ...]] = []

    @property
    def name(self) -> str:
        return self._name

    def prepare(self, messages: Sequence[Message]) -> None:
        assert messages

    def complete(
        self,
        messages: Sequence[Message],
        *,
        gbnf: str | None = None,
        max_tokens: int = 256,
        temperature: float = 0.0,
        seed: int = 0,
    ) -> Completion:
        assert (max_tokens, temperature, seed) == (256, 0.0, 0)
        instruction = messages[-1].content.rsplit("Passenger: ", 1)[-1]
        self.asked.append(instruction)
        self.constrained.append(gbnf is not None)
        self.prompts.append(tuple(messages))
        scripted = self._answers.get(instruction, REFUSAL)
        answer = scripted if isinstance(scripted, Answer) else Answer(scripted)
        return Completion(answer.text, len(answer.text.split()), 0, log(answer.confidence), answer.finished)


class BrokenModel(FakeModel):
    """Has no answer to one instruction, as if the process were killed there."""

    def __init__(self, breaks_at: str, answers: Mapping[str, Answer | str] | None = None) -> None:
        super().__init__(answers)
        self._breaks_at = breaks_at

    def complete(
        self,
        messages: Sequence[Message],
        *,
        gbnf: str | None = None,
        max_tokens: int = 256,
        temperature: float = 0.0,
        seed: int = 0,
    ) -> Completion:
        if messages[-1].content.endswith(self._breaks_at):
            raise KeyboardInterrupt
        return super().complete(messages, gbnf=gbnf, max_tokens=max_tokens, temperature=temperature, seed=seed)
