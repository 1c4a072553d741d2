"""The table of ablations: its rows, and that an interrupted measurement goes on."""

import json
from pathlib import Path

import pytest

from tests.fake_model import BrokenModel, FakeModel
from tests.programs import program
from tests.town import TOWN
from wayword.models import PromptStyle, Record, Translator
from wayword.models.evaluation.ablation import Configuration, configurations, digest, measure
from wayword.models.evaluation.translation import Result, TranslatorFor
from wayword.models.validation import clean

LEFT = program("TURN", direction="left")
# JSON leaves these as they are, and they are line ends to some readers.
WORDS = ("Turn left.", "left\u2028please", "left\x85now", "à gauche", "往左转")
RECORDS = [
    Record(id=f"r{number}", instruction=words, program=LEFT, category="COOPERATION", tags=("left",))
    for number, words in enumerate(WORDS)
]
SEEN = [clean(words) for words in WORDS]  # by the model
ANSWERS = dict.fromkeys(SEEN[::2], LEFT)
ROW = Configuration(PromptStyle.BASELINE, tuned=False, constrained=False)


def translators(model: FakeModel) -> TranslatorFor:
    return lambda places: Translator(model, places, ROW.style)


def run(
    kept: Path, model: FakeModel, records: list[Record] = RECORDS, row: Configuration = ROW
) -> tuple[list[Result], list[str]]:
    """The results, and the ids that progress was told of."""
    told: list[str] = []
    results = measure(row, translators(model), TOWN, records, kept, lambda result: told.append(result.id))
    return results, told


@pytest.fixture
def interrupted(tmp_path: Path) -> Path:
    """The file of a measurement that ended amid the fourth of five records."""
    kept = tmp_path / "out" / "row.jsonl"
    with pytest.raises(KeyboardInterrupt):
        run(kept, BrokenModel(SEEN[3], ANSWERS))
    return kept


def test_the_table_has_the_published_rows_for_each_model_and_each_way_of_decoding() -> None:
    rows = list(configurations())
    assert len(rows) == len({row.name for row in rows}) == 4 * 2 * 2 + 2
    assert len({row.name.replace(" ", "-") for row in rows}) == len(rows), "files of their own"
    assert all(row.tuned for row in rows if row.style is PromptStyle.TUNED)
    for style in set(PromptStyle) - {PromptStyle.TUNED}:
        combinations = {(row.tuned, row.constrained) for row in rows if row.style is style}
        assert combinations == {(True, True), (True, False), (False, True), (False, False)}
    assert Configuration(PromptStyle.NO_STATUS, tuned=True, constrained=True).name == "tuned no-status grammar"


@pytest.mark.parametrize("constrained", [True, False])
def test_a_row_is_measured_and_kept(tmp_path: Path, constrained: bool) -> None:
    model, kept = FakeModel(ANSWERS), tmp_path / "new" / "row.jsonl"
    results, told = run(kept, model, row=Configuration(PromptStyle.BASELINE, tuned=False, constrained=constrained))
    assert [result.correct for result in results] == [True, False, True, False, True]
    assert told == ["r0", "r1", "r2", "r3", "r4"]
    assert model.constrained == [constrained] * 5
    assert len(kept.read_text(encoding="utf-8").split("\n")) == 1 + 5 + 1


def test_what_is_measured_already_is_read(tmp_path: Path) -> None:
    kept = tmp_path / "row.jsonl"
    first, _ = run(kept, FakeModel(ANSWERS))
    again = FakeModel()
    second, told = run(kept, again)
    assert second == first
    assert told == ["r0", "r1", "r2", "r3", "r4"]
    assert again.asked == []


def test_an_interrupted_row_goes_on(interrupted: Path) -> None:
    model = FakeModel(ANSWERS)
    results, told = run(interrupted, model)
    assert model.asked == SEEN[3:]
    assert [result.id for result in results] == told == ["r0", "r1", "r2", "r3", "r4"]
    assert [result.correct for result in results] == [True, False, True, False, True]
    assert run(interrupted, FakeModel())[0] == results


@pytest.mark.parametrize("end", [1, 7, 40])
def test_a_last_line_cut_off_is_dropped(interrupted: Path, end: int) -> None:
    content = interrupted.read_bytes()
    interrupted.write_bytes(content[:-end])
    model = FakeModel(ANSWERS)
    results, _ = run(interrupted, model)
    assert model.asked == SEEN[2:]
    assert [result.id for result in results] == ["r0", "r1", "r2", "r3", "r4"]
    assert run(interrupted, FakeModel())[0] == results


def test_a_line_cut_off_amid_a_character_is_dropped(interrupted: Path) -> None:
    with interrupted.open("ab") as file:
        file.write('{"id": "r3", "instruction": "à'.encode()[:-1])
    model = FakeModel(ANSWERS)
    assert len(run(interrupted, model)[0]) == 5
    assert model.asked == SEEN[3:]


@pytest.mark.parametrize("left", ["", "{", '{"configuration": "x"}\n', "\n"])
def test_a_file_without_a_header_of_its_own_starts_anew(tmp_path: Path, left: str) -> None:
    kept, model = tmp_path / "row.jsonl", FakeModel(ANSWERS)
    kept.write_text(left, encoding="utf-8")
    run(kept, model)
    assert model.asked == SEEN
    assert run(kept, FakeModel(ANSWERS))[1] == ["r0", "r1", "r2", "r3", "r4"]


def test_a_file_of_another_model_starts_anew(interrupted: Path) -> None:
    model = FakeModel(ANSWERS, name="another")
    run(interrupted, model)
    assert model.asked == SEEN
    assert json.loads(interrupted.read_text(encoding="utf-8").split("\n")[0])["model"] == "another"


def test_a_file_of_another_data_set_starts_anew(interrupted: Path) -> None:
    changed = [*RECORDS[:-1], RECORDS[-1].model_copy(update={"program": program("KEEP_LANE")})]
    model = FakeModel(ANSWERS)
    run(interrupted, model, changed)
    assert model.asked == SEEN


def test_a_file_of_another_configuration_starts_anew(interrupted: Path) -> None:
    model = FakeModel(ANSWERS)
    run(interrupted, model, row=Configuration(PromptStyle.KB_ONLY, tuned=False, constrained=False))
    assert model.asked == SEEN


def test_the_digest_is_of_content_and_order() -> None:
    assert digest(RECORDS) == digest([record.model_copy() for record in RECORDS])
    assert len({digest(RECORDS), digest(RECORDS[::-1]), digest(RECORDS[1:]), digest([])}) == 4
