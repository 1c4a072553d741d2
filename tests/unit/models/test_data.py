"""Data files and weights: what is wrong with them is named."""

from pathlib import Path

import pytest

from wayword.models import DatasetError, ModelError, model_path, read_records
from wayword.models.embedded import EmbeddedModel

GOOD = '{"id": "1", "instruction": "Go.", "program": "command_type: MISSION\\naction: START\\n", "category": "MISSION"}'


def test_records_come_back_and_empty_lines_are_passed_over(tmp_path: Path) -> None:
    path = tmp_path / "data.jsonl"
    path.write_text(GOOD + "\n\n", encoding="utf-8")
    (record,) = read_records(path)
    assert (record.id, record.instruction, record.status, record.tags) == ("1", "Go.", None, ())


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ('{"id": "1"}', "instruction: Field required"),
        ("{", "data.jsonl:2"),
        (GOOD[:-1] + ', "x": 1}', "x: unknown key"),
    ],
)
def test_a_bad_line_is_named(tmp_path: Path, line: str, message: str) -> None:
    path = tmp_path / "data.jsonl"
    path.write_text(GOOD + "\n" + line + "\n", encoding="utf-8")
    with pytest.raises(DatasetError, match=message):
        list(read_records(path))


def test_the_embedded_model_is_found() -> None:
    assert model_path().name == "SmolLM2-135M-Instruct.Q4_1.gguf"


def test_a_model_that_is_missing_or_no_gguf_never_reaches_llama(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="no model file"):
        model_path(str(tmp_path / "none.gguf"))
    path = tmp_path / "bad.gguf"
    path.write_bytes(b"not a model")
    with pytest.raises(ModelError, match="no GGUF file"):
        model_path(str(path))


def test_a_broken_gguf_is_named(tmp_path: Path) -> None:
    path = tmp_path / "broken.gguf"
    path.write_bytes(b"GGUF\x03\0\0\0garbage")
    with pytest.raises(ModelError, match=r"broken\.gguf can't be loaded"):
        EmbeddedModel(path)
