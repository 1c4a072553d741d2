"""The embedded model: any GGUF file, in process through llama.cpp."""

import os
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from typing import cast

import numpy as np
from llama_cpp import Llama, llama_get_logits_ith
from llama_cpp.llama_chat_format import Jinja2ChatFormatter
from llama_cpp.llama_grammar import LlamaGrammar
from llama_cpp.llama_types import ChatCompletionRequestMessage

from wayword.grammar import check_gbnf
from wayword.models.backend import Completion, InstructionError, Message
from wayword.models.registry import ModelError

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
        self._open_ended = self._formatter(ends_with_answer=False)
        self._answering = self._formatter(ends_with_answer=True)

    @property
    def name(self) -> str:
        """The file's name without its ending."""
        return self.path.stem

    def prepare(self, messages: Sequence[Message]) -> None:
        """Reads the constant beginning of prompts into the key-value cache."""
        tokens = self._tokens(messages, self._open_ended)
        next(self._llama.generate(tokens, temp=0.0))

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
        prompt = self._tokens(messages, self._answering)
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
            mean_log_probability=float(np.mean(log_probabilities)),
            finished=finished,
        )

    def _stream(self, prompt: list[int], gbnf: str | None, temperature: float) -> Iterator[int]:
        grammar = _grammar(gbnf) if gbnf is not None else None
        if temperature == 0.0:
            yield from self._llama.generate(prompt, temp=0.0, grammar=grammar)
        else:  # sample from the whole distribution: no top-k, top-p or min-p cut
            yield from self._llama.generate(prompt, temp=temperature, top_k=0, top_p=1.0, min_p=0.0, grammar=grammar)

    def _formatter(self, *, ends_with_answer: bool) -> Jinja2ChatFormatter:
        """Writes conversations as the model was trained on them, up to the answer's opening if wanted."""
        return Jinja2ChatFormatter(
            template=self._llama.metadata.get("tokenizer.chat_template", _CHATML),
            eos_token=self._token_text(self._llama.token_eos()),
            bos_token=self._token_text(self._llama.token_bos()),
            add_generation_prompt=ends_with_answer,
        )

    def _tokens(self, messages: Sequence[Message], formatter: Jinja2ChatFormatter) -> list[int]:
        """The tokens of a conversation.

        Only the template may open and close turns: what somebody said is no template, even if it spells out control
        tokens. So the template is filled with marks, and the parts are tokenised apart.
        """
        marks = [f"\ue000{number}\ue001" for number in range(len(messages))]
        turns = [
            cast(ChatCompletionRequestMessage, {"role": message.role, "content": mark})
            for message, mark in zip(messages, marks, strict=True)
        ]
        rest = formatter(messages=turns).prompt
        tokens: list[int] = []
        for message, mark in zip(messages, marks, strict=True):
            before, rest = rest.split(mark, 1)
            tokens += self._llama.tokenize(before.encode(), add_bos=False, special=True)
            tokens += self._llama.tokenize(message.content.encode(), add_bos=False, special=False)
        return tokens + self._llama.tokenize(rest.encode(), add_bos=False, special=True)

    def _token_text(self, token: int) -> str:
        return self._llama.detokenize([token], special=True).decode("utf-8", errors="replace") if token >= 0 else ""

    def _is_end(self, token: int) -> bool:
        return token in (self._llama.token_eos(), self._llama.token_bos()) or token < 0

    def _log_probability(self, token: int) -> float:
        """Natural-log probability of the token that was just sampled, from the logits that it was sampled from."""
        pointer = llama_get_logits_ith(self._llama.ctx, -1)
        logits = np.ctypeslib.as_array(pointer, shape=(self._llama.n_vocab(),)).astype(np.float64)
        peak = logits.max()
        return float(logits[token] - peak - np.log(np.exp(logits - peak).sum()))


@lru_cache(maxsize=8)
def _grammar(gbnf: str) -> LlamaGrammar:
    check_gbnf(gbnf)
    return LlamaGrammar.from_string(gbnf, verbose=False)


# For weights that bring no template of their own.
_CHATML = (
    "{% for message in messages %}<|im_start|>{{ message['role'] }}\n{{ message['content'] }}<|im_end|>\n{% endfor %}"
    "{% if add_generation_prompt %}<|im_start|>assistant\n{% endif %}"
)
