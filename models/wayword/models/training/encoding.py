"""Instructions with their programs as tokens, and which of these tokens the loss counts."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random

from wayword.compiler import VehicleStatus
from wayword.models.chat import ChatTokenizer
from wayword.models.prefix import common_prefix_length
from wayword.models.prompt import prompt_messages

# Largest number of tokens in a chunk, padding included: enough to keep the cores busy, and few enough that sequences
# of a chunk, which are sorted by length, need little padding.
_CHUNK_TOKENS = 640

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
    """Sequences that begin with the same tokens, which are evaluated once.

    Attributes:
        prefix: These tokens.
        chunks: The sequences; those of a chunk are of similar length and are evaluated side by side.
    """

    prefix: list[int]
    chunks: list[list[TokenSequence]]

    @property
    def sequences(self) -> list[TokenSequence]:
        """All sequences, chunk by chunk."""
        return [sequence for chunk in self.chunks for sequence in chunk]


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
        """Encodes the samples of a step as batches of equal scene."""
        scenes: dict[str, list[Sample]] = {}
        for sample in samples:
            scenes.setdefault(f"{sample.places}{sample.status!r}", []).append(sample)
        alone = [group[0] for group in scenes.values() if len(group) == 1]
        groups = [group for group in scenes.values() if len(group) > 1] + ([alone] if alone else [])
        return [self._batch(group, rng) for group in groups]

    def _batch(self, samples: Sequence[Sample], rng: Random) -> Batch:
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
        return Batch(encoded[0][0][:shared], list(_chunks(sequences)))

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


def _chunks(sequences: Sequence[TokenSequence]) -> Iterator[list[TokenSequence]]:
    """Cuts sequences, sorted by length, into chunks."""
    chunk: list[TokenSequence] = []
    for sequence in sequences:
        if chunk and len(sequence.tokens) * (len(chunk) + 1) > _CHUNK_TOKENS:
            yield chunk
            chunk = []
        chunk.append(sequence)
    yield chunk
