"""The event log."""

from pathlib import Path

import pytest

from wayword.runtime.recording import LogError, Recorder, read_log


def test_events_come_back_as_they_were_recorded(tmp_path: Path) -> None:
    path = tmp_path / "deep" / "log.jsonl"
    with Recorder(path) as recorder:
        recorder.record("instruction", 1.23456, id="t0", text="“Go!\u2028\x85”")
        assert list(read_log(path)) == [{"event": "instruction", "t": 1.235, "id": "t0", "text": "“Go!\u2028\x85”"}]


def test_a_broken_line_is_named(tmp_path: Path) -> None:
    path = tmp_path / "log.jsonl"
    path.write_text('{"event": "a", "t": 0}\n{"event":', encoding="utf-8")
    with pytest.raises(LogError, match=r"log\.jsonl:2"):
        list(read_log(path))


def test_a_missing_log_is_named(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="nothing"):
        list(read_log(tmp_path / "nothing"))
