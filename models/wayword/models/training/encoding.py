"""Instructions with their programs as tokens, and which of these tokens the loss counts."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random

from wayword.compiler import VehicleStatus
from wayword.models.chat import ChatTokenizer
from wayword.models.prefix import common_prefix_length
from wayword.models.prompt import prompt_messages

# Largest size of a batch, padding included: enough to keep the cores busy, little enough to waste no padding.
PADDED_TOKENS = 1500

# What the grammar forces once its first token is out.
_KEY_WORDS = re.compile(r"(?m)^(command_type:|action:|parameters:|  - name:|    value:)")


@dataclass(frozen=True, slots=True)
class Sample:
    """One instruction as a model is trained on it."""

    instruction: str
    program: str
    status: VehicleStatus
    places: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class TokenSequence:
    """Tokens of a sample after the prefix that its batch shares.

    Attributes:
        tokens: Rest of the prompt and the program with its end token.
        targets: Positions in `tokens` that the loss counts; position i is predicted from what stands before it.
    """

    tokens: list[int]
    targets: list[int]


@dataclass(frozen=True, slots=True)
class Batch:
    """Sequences with the tokens that all of them begin with, which are evaluated once."""

    prefix: list[int]
    sequences: list[TokenSequence]


class Encoder:
    """Turns samples into batches of tokens.

    Args:
        tokenizer: The model's tokeniser.
        structure_share: Share of the samples whose loss counts the key words too.
    """

    def __init__(self, tokenizer: ChatTokenizer, structure_share: float) -> None:
        self._tokenizer = tokenizer
        self._structure_share = structure_share

    def batches(self, samples: Sequence[Sample], rng: Random) -> list[Batch]:
        """Encodes the samples of a step as batches of equal scene and similar length."""
        scenes: dict[str, list[Sample]] = {}
        for sample in samples:
            scenes.setdefault(f"{sample.places}{sample.status!r}", []).append(sample)
        alone = [group[0] for group in scenes.values() if len(group) == 1]
        groups = [group for group in scenes.values() if len(group) > 1] + ([alone] if alone else [])
        return [batch for group in groups for batch in self._batches_of(group, rng)]

    def _batches_of(self, samples: Sequence[Sample], rng: Random) -> Iterator[Batch]:
        encoded = [self._encode(sample, rng) for sample in samples]
        # Whatever prefix the prompts have in common is the batch's, but for one token, so that even equal prompts
        # leave a position to predict the program's first token from.
        common = common_prefix_length([tokens[:start] for tokens, start, _ in encoded])
        shared = min(common, *(start - 1 for _, start, _ in encoded))
        sequences = [
            TokenSequence(tokens[shared:], [start - shared + index for index in counted])
            for tokens, start, counted in encoded
        ]
        sequences.sort(key=lambda sequence: len(sequence.tokens))
        prefix = encoded[0][0][:shared]
        chunk: list[TokenSequence] = []
        for sequence in sequences:
            if chunk and len(sequence.tokens) * (len(chunk) + 1) > PADDED_TOKENS:
                yield Batch(prefix, chunk)
                chunk = []
            chunk.append(sequence)
        yield Batch(prefix, chunk)

    def _encode(self, sample: Sample, rng: Random) -> tuple[list[int], int, list[int]]:
        """The tokens of prompt and program, where the program starts, and which of its tokens count."""
        prompt = self._tokenizer.conversation(prompt_messages(sample.instruction, sample.status, sample.places))
        answer = [*self._tokenizer.text(sample.program), self._tokenizer.end]
        counted = self._counted(sample.program, answer, whole=rng.random() < self._structure_share)
        return [*prompt, *answer], len(prompt), counted

    def _counted(self, program: str, answer: Sequence[int], *, whole: bool) -> list[int]:
        if whole:
            return list(range(len(answer)))
        forced = [match.span() for match in _KEY_WORDS.finditer(program)]
        counted, offset = [], 0
        for index, token in enumerate(answer[:-1]):
            if not any(start < offset < end for start, end in forced):
                counted.append(index)
            offset += len(self._tokenizer.piece(token))
        return [*counted, len(answer) - 1]
