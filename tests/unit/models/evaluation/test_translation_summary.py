"""Figures of an evaluation: translated, compared, added up."""

import json
from typing import NoReturn

import pytest

from tests.fake_model import Answer, FakeModel
from tests.programs import join, program
from tests.town import TOWN
from wayword.models import InstructionError, Record, Translator
from wayword.models.evaluation.translation import (
    Result,
    TranslatorFor,
    from_json,
    latency,
    summary,
    to_json,
    translate_all,
)
from wayword.models.translator import MAX_INSTRUCTION_CHARACTERS

FIFTY, LEFT = program("SET_PARAM", max_vel="50 km/h"), program("TURN", direction="left")
FAST = program("SET_PARAM", max_vel="250 km/h")
SPEED = program("QUERY", item="speed")

RECORDS = [
    Record(id="a", instruction="Fifty.", program=FIFTY, category="CONFIG", tags=("number",)),
    Record(id="b", instruction="Left.", program=LEFT, category="COOPERATION"),
    Record(id="c", instruction="Drive 250.", program=FAST, category="CONFIG", tags=("number", "absurd")),
    Record(id="d", instruction="How fast?", program=SPEED, category="INFO"),
]
ANSWERS: dict[str, Answer | str] = {
    "Fifty.": program("SET_PARAM", max_vel="50.0 km/h"),
    "Left.": Answer(program("TURN", direction="right"), confidence=0.3),
    "Drive 250.": FAST,
    "How fast?": "About fifty, I think.",
}


def translators(model: FakeModel) -> TranslatorFor:
    return lambda places: Translator(model, places)


def evaluate(*records: Record, answers: dict[str, Answer | str] | None = None) -> list[Result]:
    return translate_all(translators(FakeModel({**ANSWERS, **(answers or {})})), TOWN, records)


def test_accuracy_in_all_by_category_and_by_tag() -> None:
    figures = summary(evaluate(*RECORDS))
    assert (figures["n"], figures["correct"], figures["accuracy"]) == (4, 2, 0.5)
    assert figures["by_category"] == {
        "CONFIG": {"n": 2, "correct": 2, "accuracy": 1.0},
        "COOPERATION": {"n": 1, "correct": 0, "accuracy": 0.0},
        "INFO": {"n": 1, "correct": 0, "accuracy": 0.0},
    }
    assert figures["by_tag"] == {
        "number": {"n": 2, "correct": 2, "accuracy": 1.0},
        "absurd": {"n": 1, "correct": 1, "accuracy": 1.0},
    }


def test_the_parse_rate_asks_for_syntax_only() -> None:
    results = evaluate(*RECORDS)
    assert [result.parsed for result in results] == [True, True, True, False]
    assert summary(results)["parse_rate"] == 0.75


def test_every_error_is_listed_with_both_programs() -> None:
    assert summary(evaluate(*RECORDS))["errors"] == [
        {
            "id": "b",
            "instruction": "Left.",
            "expected": LEFT,
            "got": program("TURN", direction="right"),
            "confidence": 0.3,
        },
        {
            "id": "d",
            "instruction": "How fast?",
            "expected": SPEED,
            "got": "About fifty, I think.",
            "confidence": 0.99,
        },
    ]


def test_programs_out_of_bounds_are_right_if_their_texts_are_equal() -> None:
    (right,) = evaluate(RECORDS[2])
    (wrong,) = evaluate(RECORDS[2], answers={"Drive 250.": FAST.replace("250", "251")})
    assert (right.correct, right.parsed) == (True, True)
    assert (wrong.correct, wrong.parsed) == (False, True)


@pytest.mark.parametrize("words", ["go " * MAX_INSTRUCTION_CHARACTERS, "停" * (MAX_INSTRUCTION_CHARACTERS + 1)])
def test_an_overlong_instruction_is_wrong_and_no_crash(words: str) -> None:
    model = FakeModel(ANSWERS)
    long = Record(id="long", instruction=words, program=LEFT, category="COOPERATION")
    results = translate_all(translators(model), TOWN, [long, RECORDS[0]])
    assert model.asked == ["Fifty."], "the model never sees it"
    assert (results[0].got, results[0].correct, results[0].parsed, results[0].confidence) == ("", False, False, 0.0)
    assert results[1].correct
    assert summary(results)["accuracy"] == 0.5


def test_an_instruction_of_the_greatest_length_is_read() -> None:
    model = FakeModel()
    words = "x" * MAX_INSTRUCTION_CHARACTERS
    translate_all(translators(model), TOWN, [Record(id="1", instruction=words, program=LEFT, category="COOPERATION")])
    assert model.asked == [words]


def test_an_instruction_of_which_nothing_can_be_seen_is_wrong_and_no_crash() -> None:
    hidden = Record(id="1", instruction="\u200b\U000e0041", program=LEFT, category="COOPERATION")
    (result,) = evaluate(hidden)
    assert (result.got, result.correct) == ("", False)


def test_a_prompt_that_the_model_has_no_room_for_is_wrong_and_no_crash() -> None:
    class Full(FakeModel):
        def complete(self, *_: object, **__: object) -> NoReturn:
            raise InstructionError("the prompt has 5000 tokens")

    (result,) = translate_all(translators(Full()), TOWN, RECORDS[:1])
    assert (result.got, result.correct) == ("", False)


def test_records_are_translated_for_their_own_places_and_status() -> None:
    model = FakeModel()
    record = Record.model_validate(
        {
            "id": "1",
            "instruction": "To Reykjavik.",
            "program": program("SET_DESTINATION", destination="Reykjavik"),
            "category": "MISSION",
            "places": ["Reykjavik", "Ulan Bator"],
            "status": {"speed_kmh": 33},
        }
    )
    translate_all(translators(model), TOWN, [record, RECORDS[0]])
    own, towns = (prompt[0].content for prompt in model.prompts)
    assert "Places: Reykjavik, Ulan Bator\n" in own
    assert "speed 33 km/h" in own
    assert "Harbor" in towns
    assert "speed 0 km/h" in towns


@pytest.mark.parametrize("constrained", [True, False])
def test_the_constraint_is_passed_on(constrained: bool) -> None:
    model = FakeModel()
    translate_all(translators(model), TOWN, RECORDS, constrained=constrained)
    assert model.constrained == [constrained] * len(RECORDS)


def test_progress_is_told_of_each_result() -> None:
    told: list[Result] = []
    results = translate_all(translators(FakeModel(ANSWERS)), TOWN, RECORDS, on_result=told.append)
    assert told == results
    assert [result.id for result in told] == ["a", "b", "c", "d"]
    assert all(result.latency_ms > 0 and result.tokens > 0 for result in told)


def test_latencies() -> None:
    assert latency([10.0, 20.0, 30.0, 100.0]) == {"mean": 40.0, "median": 25.0, "p95": 89.5}
    assert latency([7.04]) == {"mean": 7.0, "median": 7.0, "p95": 7.0}
    assert latency([]) == {"mean": None, "median": None, "p95": None}


def test_nothing_evaluated_is_no_crash() -> None:
    figures = summary([])
    assert (figures["n"], figures["accuracy"], figures["errors"]) == (0, 0.0, [])


def test_a_result_survives_its_file() -> None:
    odd = Record(id="é", instruction="a\u2028b", program=join(LEFT, FIFTY), category="COOPERATION", tags=("x", "y"))
    for result in evaluate(*RECORDS, odd):
        assert from_json(json.loads(json.dumps(to_json(result)))) == result
