"""Conversations as tokens, as a GGUF model's own chat template and tokeniser write them."""

from collections.abc import Sequence
from typing import cast

from llama_cpp import Llama
from llama_cpp.llama_chat_format import Jinja2ChatFormatter
from llama_cpp.llama_types import ChatCompletionRequestMessage

from wayword.models.backend import Message

# For weights that bring no template of their own.
_CHATML = (
    "{% for message in messages %}<|im_start|>{{ message['role'] }}\n{{ message['content'] }}<|im_end|>\n{% endfor %}"
    "{% if add_generation_prompt %}<|im_start|>assistant\n{% endif %}"
)


class ChatTokenizer:
    """Tokenises conversations and text. Inference and fine-tuning share it, so that both see the same tokens.

    Args:
        llama: The model; loading only its vocabulary is enough.
    """

    def __init__(self, llama: Llama) -> None:
        self._llama = llama
        self._open_ended = self._formatter(ends_with_answer=False)
        self._answering = self._formatter(ends_with_answer=True)

    @property
    def end(self) -> int:
        """The token that ends an answer."""
        return self._llama.token_eos()

    def conversation(self, messages: Sequence[Message], *, answering: bool = True) -> list[int]:
        """The tokens of a conversation.

        Only the template may open and close turns: what somebody said is no template, even if it spells out control
        tokens. So the template is filled with marks, and the parts are tokenised apart.

        Args:
            messages: The turns.
            answering: Whether the assistant's next turn is opened at the end.
        """
        marks = [f"\ue000{number}\ue001" for number in range(len(messages))]
        turns = [
            cast(ChatCompletionRequestMessage, {"role": message.role, "content": mark})
            for message, mark in zip(messages, marks, strict=True)
        ]
        rest = (self._answering if answering else self._open_ended)(messages=turns).prompt
        tokens: list[int] = []
        for message, mark in zip(messages, marks, strict=True):
            before, rest = rest.split(mark, 1)
            tokens += self._control(before) + self.text(message.content)
        return tokens + self._control(rest)

    def text(self, text: str) -> list[int]:
        """The tokens of a text; control tokens that it spells out are plain text."""
        return self._llama.tokenize(text.encode(), add_bos=False, special=False)

    def piece(self, token: int) -> str:
        """The text that a token stands for."""
        return self._llama.detokenize([token]).decode("utf-8", errors="replace")

    def _control(self, text: str) -> list[int]:
        return self._llama.tokenize(text.encode(), add_bos=False, special=True)

    def _formatter(self, *, ends_with_answer: bool) -> Jinja2ChatFormatter:
        """Writes conversations as the model was trained on them, up to the answer's opening if wanted."""
        return Jinja2ChatFormatter(
            template=self._llama.metadata.get("tokenizer.chat_template", _CHATML),
            eos_token=self._token_text(self._llama.token_eos()),
            bos_token=self._token_text(self._llama.token_bos()),
            add_generation_prompt=ends_with_answer,
        )

    def _token_text(self, token: int) -> str:
        return self._llama.detokenize([token], special=True).decode("utf-8", errors="replace") if token >= 0 else ""
