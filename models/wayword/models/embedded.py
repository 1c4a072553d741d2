"""The embedded model: any GGUF file, in process through llama.cpp."""

import os
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from functools import lru_cache
from pathlib import Path

import numpy as np
from llama_cpp import Llama, llama_get_logits_ith
from llama_cpp.llama_grammar import LlamaGrammar
from numpy.typing import NDArray

from wayword.grammar import check_gbnf
from wayword.models.backend import Completion, InstructionError, Message
from wayword.models.chat import ChatTokenizer
from wayword.models.constraint import TokenConstraint
from wayword.models.errors import ModelError
from wayword.models.prefix import common_prefix_length

CONTEXT_TOKENS = 4096


class EmbeddedModel:
    """A GGUF model in this process.

    The key-value cache of the longest common beginning of two prompts in a row is kept, so that the constant part of
    a prompt is read once.

    Args:
        path: The GGUF file.
        threads: Number of threads; None takes all cores.

    Raises:
        ModelError: llama.cpp can't load the file.
    """

    def __init__(self, path: Path, threads: int | None = None) -> None:
        self.path = path
        threads = threads or os.cpu_count() or 1
        try:
            self._llama = Llama(
                str(path), n_ctx=CONTEXT_TOKENS, n_threads=threads, n_threads_batch=threads, verbose=False
            )
        except ValueError as error:
            raise ModelError(f"{path} can't be loaded, it may be incomplete or of an unknown kind: {error}") from error
        self.tokenizer = ChatTokenizer(self._llama)

    @property
    def name(self) -> str:
        """The file's name without its ending."""
        return self.path.stem

    def prepare(self, messages: Sequence[Message]) -> None:
        """Reads the constant beginning of prompts into the key-value cache."""
        self._read(self.tokenizer.conversation(messages, answering=False))

    def complete(
        self,
        messages: Sequence[Message],
        *,
        gbnf: str | None = None,
        max_tokens: int = 256,
        temperature: float = 0.0,
        seed: int = 0,
    ) -> Completion:
        """Continues a conversation; see :class:`~wayword.models.backend.LanguageModel`.

        Raises:
            GrammarError: The grammar is not one that llama.cpp can take; it is checked before llama.cpp sees it.
            InstructionError: The prompt leaves no room for `max_tokens` in the context.
        """
        prompt = self.tokenizer.conversation(messages)
        if len(prompt) + max_tokens > CONTEXT_TOKENS:
            raise InstructionError(
                f"the prompt has {len(prompt)} tokens, with {max_tokens} for the answer that is more than the "
                f"{CONTEXT_TOKENS} of the context; shorten the instruction"
            )
        self._llama.set_seed(seed)
        answer: list[int] = []
        log_probabilities: list[float] = []
        finished = False
        for token in self._stream(prompt, gbnf, temperature):
            log_probabilities.append(self._log_probability(token))
            if self._is_end(token):
                finished = True
                break
            answer.append(token)
            if len(answer) >= max_tokens:
                break
        return Completion(
            text=self._llama.detokenize(answer, prev_tokens=prompt).decode("utf-8", errors="replace"),
            tokens=len(answer),
            forced_tokens=0,  # llama.cpp's own sampler evaluates the model for every token
            log_probability=float(np.sum(log_probabilities)),
            finished=finished,
        )

    def _stream(self, prompt: list[int], gbnf: str | None, temperature: float) -> Iterator[int]:
        if temperature == 0.0:
            yield from self._greedy(prompt, gbnf)
        else:  # sample from the whole distribution: no top-k, top-p or min-p cut
            grammar = _grammar(gbnf) if gbnf is not None else None
            yield from self._llama.generate(prompt, temp=temperature, top_k=0, top_p=1.0, min_p=0.0, grammar=grammar)

    def _greedy(self, prompt: list[int], gbnf: str | None) -> Iterator[int]:
        """The most probable token each time, among those that the grammar allows."""
        self._read(prompt)
        with TokenConstraint(self._llama, gbnf) if gbnf is not None else nullcontext() as constraint:
            while True:
                logits = self._logits()
                token = int(logits.argmax()) if constraint is None else constraint.best(logits)
                yield token
                if constraint is not None:
                    constraint.accept(token)
                self._llama.eval([token])

    def _read(self, prompt: list[int]) -> None:
        """Evaluates a prompt, but for what it has in common with what was evaluated last."""
        before = self._llama.input_ids[: self._llama.n_tokens].tolist()
        # The last token is evaluated in any case: the logits after it are wanted.
        kept = min(common_prefix_length([before, prompt]), len(prompt) - 1)
        self._llama.n_tokens = kept
        self._llama.eval(prompt[kept:])

    def _logits(self) -> NDArray[np.single]:
        """The logits after the last token, shape (vocabulary,); valid until the next evaluation."""
        return np.ctypeslib.as_array(llama_get_logits_ith(self._llama.ctx, -1), shape=(self._llama.n_vocab(),))

    def _is_end(self, token: int) -> bool:
        return token in (self._llama.token_eos(), self._llama.token_bos()) or token < 0

    def _log_probability(self, token: int) -> float:
        """Natural-log probability of the token that was just sampled, from the logits that it was sampled from."""
        logits = self._logits().astype(np.float64)
        peak = logits.max()
        return float(logits[token] - peak - np.log(np.exp(logits - peak).sum()))


@lru_cache(maxsize=8)
def _grammar(gbnf: str) -> LlamaGrammar:
    check_gbnf(gbnf)
    return LlamaGrammar.from_string(gbnf, verbose=False)
