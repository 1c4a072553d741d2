"""A grammar on the tokens of a model: llama.cpp's own engine, asked about as little as possible."""

import ctypes
from types import TracebackType
from typing import Self

import llama_cpp
import numpy as np
from llama_cpp import Llama
from numpy.typing import NDArray

from wayword.grammar import check_gbnf
from wayword.models.errors import ModelError


class TokenConstraint:
    """What a GBNF grammar allows next, from the start of an answer on. A context manager.

    Args:
        llama: The model whose tokens are meant.
        gbnf: The grammar.

    Raises:
        GrammarError: The grammar is not one that llama.cpp can take; it is checked before llama.cpp sees it.
        ModelError: llama.cpp refuses it all the same.
    """

    def __init__(self, llama: Llama, gbnf: str) -> None:
        check_gbnf(gbnf)
        vocabulary = llama_cpp.llama_model_get_vocab(llama.model)
        self._sampler = llama_cpp.llama_sampler_init_grammar(vocabulary, gbnf.encode(), b"root")
        if not self._sampler:
            raise ModelError("llama.cpp can't take the grammar for this model's vocabulary")
        self._entries = np.zeros(
            llama.n_vocab(), dtype=np.dtype([("id", np.intc), ("logit", np.single), ("p", np.single)], align=True)
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        llama_cpp.llama_sampler_free(self._sampler)

    def best(self, logits: NDArray[np.single]) -> int:
        """The most probable token that the grammar allows.

        The most probable token of all is tried alone first: for a model that knows the language it nearly always
        passes, and masking the whole vocabulary costs as much as evaluating a small model.

        Args:
            logits: Shape (vocabulary,).
        """
        likeliest = int(logits.argmax())
        self._entries["id"][0], self._entries["logit"][0] = likeliest, logits[likeliest]
        if np.isfinite(self._mask(1)["logit"][0]):
            return likeliest
        self._entries["id"] = np.arange(len(self._entries))
        self._entries["logit"] = logits
        return int(self._mask(len(self._entries))["logit"].argmax())

    def accept(self, token: int) -> None:
        """Takes a token as the next one."""
        llama_cpp.llama_sampler_accept(self._sampler, token)

    def _mask(self, count: int) -> NDArray[np.void]:
        """Sets the logits of forbidden tokens among the first entries to minus infinity; keeps their order."""
        candidates = llama_cpp.llama_token_data_array(
            data=self._entries.ctypes.data_as(llama_cpp.llama_token_data_p), size=count, selected=-1, sorted=False
        )
        llama_cpp.llama_sampler_apply(self._sampler, ctypes.byref(candidates))
        return self._entries[:count]
