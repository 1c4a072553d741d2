"""The shipped data files: well-formed, complete, and training data apart from test data."""

import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import wayword.models
from tests.town import TOWN
from wayword.compiler import Compilation, compile_program
from wayword.compiler.vocabulary import ACTIONS, DRIVING_PARAMETERS, Choice, CommandType, Quantity
from wayword.models import Record, datacard, read_records
from wayword.models.datasets import TEST_SETS
from wayword.models.training.leakage import leaks, normal_form

DATA = Path(wayword.models.__file__).parent / "data"
TEMPLATES = DATA / "train" / "references.jsonl"  # their programs hold expressions: see test_references.py
TRAINING = sorted((DATA / "train").glob("*.jsonl"))
HELD_OUT = [DATA / f"{name}.jsonl" for name in TEST_SETS]
FILES = [*TRAINING, *HELD_OUT, DATA / "examples.jsonl"]

# What ends a program (language.md section 1): nothing that follows would be run.
ENDS = re.compile(r"action: (EMERGENCY_STOP|CLARIFY)|value: (unsafe|unknown_place)")


@cache
def records(path: Path) -> list[Record]:
    return list(read_records(path))


def training() -> list[Record]:
    return [record for path in TRAINING for record in records(path)]


def held_out() -> list[str]:
    return [record.instruction for path in HELD_OUT for record in records(path)]


def name(path: Path) -> str:
    return path.stem


def in_canonical_form(source: str, result: Compilation, places: tuple[str, ...]) -> bool:
    """Whether a program is canonical, its values outside the bounds put aside (they leave it without a canonical form).

    A diagnostic of bounds names the value in canonical form, and then the bounds.
    """
    lines = source.split("\n")
    for diagnostic in result.diagnostics:
        value = diagnostic.message.split(": ")[1]
        if lines[diagnostic.span.line - 1] != f"    value: {value}":
            return False
        assert diagnostic.help is not None
        highest = diagnostic.help.removesuffix(" are allowed").split(" or ")[0].split(" to ")[1]
        lines[diagnostic.span.line - 1] = f"    value: {highest}"
    settled = "\n".join(lines)
    return compile_program(settled, places).canonical == settled


def test_all_files_are_looked_at() -> None:
    assert set(FILES) == set(DATA.rglob("*.jsonl"))


@pytest.mark.parametrize("path", [path for path in FILES if path != TEMPLATES], ids=name)
def test_every_program_compiles_and_is_canonical(path: Path) -> None:
    for record in records(path):
        places = record.places or TOWN
        result = compile_program(record.program, places)
        # The model translates, it does not judge bounds (language.md section 4, rule 1).
        assert {diagnostic.code.name for diagnostic in result.diagnostics} <= {"WW0303"}, record
        assert in_canonical_form(record.program, result, places), record
        assert not any(ENDS.search(command) for command in record.program.split("---\n")[:-1]), record


@pytest.mark.parametrize("path", FILES, ids=name)
def test_records_are_whole(path: Path) -> None:
    of_file = records(path)
    assert len({record.id for record in of_file}) == len(of_file)
    for record in of_file:
        assert record.category == record.program.split("\n")[0].removeprefix("command_type: "), record
        assert record.instruction.strip(), record
        if record.status is not None:
            named = {record.status.destination, *record.status.waypoints} - {None}
            assert named <= set(record.places or TOWN), record


def test_ids_are_unique_over_all_files() -> None:
    assert max(Counter(record.id for path in FILES for record in records(path)).values()) == 1


@pytest.mark.parametrize("file", ["benchmark", "dev"])
def test_the_measured_sets_have_two_hundred_records_of_equal_categories(file: str) -> None:
    of_file = records(DATA / f"{file}.jsonl")
    categories = Counter(record.category for record in of_file)
    assert len(of_file) == 200
    assert set(categories) == set(CommandType)
    assert max(categories.values()) - min(categories.values()) <= 2
    tags = Counter(tag for record in of_file for tag in record.tags)
    assert min(tags[tag] for tag in ("several commands", "status", "other map")) >= 10
    assert {action for record in of_file for action in actions(record)} == set(ACTIONS)


def test_the_activation_set_asks_for_nothing() -> None:
    of_file = records(DATA / "activation.jsonl")
    assert len(of_file) >= 500
    assert {action for record in of_file for action in actions(record)} == {"REJECT", "CLARIFY"}


def test_the_attack_set_is_large_and_refused() -> None:
    of_file = records(DATA / "attack.jsonl")
    assert len(of_file) >= 150
    assert {action for record in of_file for action in actions(record)} == {"REJECT"}
    kinds = {tag for record in of_file for tag in record.tags}
    assert kinds >= {"injection", "roleplay", "disguise", "unicode", "long", "language"}


def test_there_are_enough_different_training_sentences() -> None:
    of_commands = [record.instruction for record in training() if not record.id.startswith("clinc150-")]
    assert len({normal_form(instruction) for instruction in of_commands}) >= 8000


def test_equal_sentences_mean_the_same_under_equal_circumstances() -> None:
    meanings: dict[str, Record] = {}
    for record in training():
        circumstances = f"{record.instruction.casefold()} {record.places} {record.status!r}"
        assert meanings.setdefault(circumstances, record).program == record.program, record


# Coverage


def actions(record: Record) -> list[str]:
    return re.findall(r"(?m)^action: (\w+)$", record.program)


def wanted() -> Iterator[tuple[str, ...]]:
    """Every action, word and unit, with and without sign, as (action, parameter, value with 0 for a number)."""
    for action in ACTIONS.values():
        yield (action.name,)
        for parameter in action.parameters:
            if isinstance(parameter.type, Choice):
                yield from ((action.name, parameter.name, option) for option in parameter.type.options)
            elif isinstance(parameter.type, Quantity):
                yield from ((action.name, parameter.name, f"0 {unit}") for unit in parameter.type.units)
    yield ("SET_PARAM", "all", "default")
    for setting in DRIVING_PARAMETERS.values():
        yield ("SET_PARAM", setting.name, "default")
        if isinstance(setting.type, Choice):
            yield from (("SET_PARAM", setting.name, option) for option in setting.type.options)
            continue
        yield from (("ADJUST_PARAM", setting.name, step) for step in ("increase", "decrease"))
        for unit in setting.type.units:
            yield ("SET_PARAM", setting.name, f"0 {unit}")
            yield from (("ADJUST_PARAM", setting.name, f"{sign}0 {unit}") for sign in "+-")


def shown(record: Record) -> Iterator[tuple[str, ...]]:
    for command in record.program.split("---\n"):
        (action,) = re.findall(r"(?m)^action: (\w+)$", command)
        yield (action,)
        for parameter, value in re.findall(r"  - name: (\w+)\n    value: (.+)\n", command):
            yield (action, parameter, re.sub(r"^([+-]?)[\d.]+ ", r"\g<1>0 ", value))


def test_training_data_show_every_action_value_unit_and_reason() -> None:
    counts = Counter(item for path in TRAINING if path != TEMPLATES for r in records(path) for item in shown(r))
    assert [item for item in wanted() if not counts[item]] == []


# Leakage


def test_training_data_hold_nothing_equal_or_nearly_equal_to_held_out_data() -> None:
    instructions = [record.instruction for record in training()]
    found = {instructions[index]: near for index, near in leaks(instructions, held_out()).items()}
    assert found == {}
    # Instructions in other scripts have no normal form, so that only this sees them.
    assert {text.casefold() for text in instructions}.isdisjoint(text.casefold() for text in held_out())


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("Turn left, please.", "um, turn left"),
        ("turn-left", "Turn   left!"),
        ("Don't stop", "dont stop"),
        ("Take me to the café", "TAKE ME TO THE CAFE"),
        ("Okay so, 2.5 seconds", "2.5 seconds"),
        ("30 km/h", "30 km h"),
    ],
)
def test_what_has_the_same_normal_form(one: str, other: str) -> None:
    assert normal_form(one) == normal_form(other)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("turn left", "turn right"),
        ("drive 50", "drive 60"),
        ("2.5 seconds", "25 seconds"),
        ("faster", "not faster"),
        ("thanks", "please"),  # where nothing else is said, courtesy is the sentence
    ],
)
def test_what_has_another_normal_form(one: str, other: str) -> None:
    assert normal_form(one) != normal_form(other)
    assert normal_form(one)


@given(st.text())
def test_a_normal_form_is_its_own(text: str) -> None:
    assert normal_form(normal_form(text)) == normal_form(text)


@pytest.mark.parametrize(
    "instruction",
    [
        "Hey, change to the left lane now, please!",  # equal but for courtesy
        "Change to the left line.",  # a word misheard
        "change too the left lane",
        "Change to the left lanes.",
    ],
)
def test_a_near_miss_is_a_leak(instruction: str) -> None:
    held = "Change to the left lane."
    assert leaks(["Go faster.", instruction], ["How far is it?", held]) == {1: held}


@pytest.mark.parametrize(
    "instruction",
    [
        "Change to the right lane.",  # the same words but for the meaning
        "Move to the left lane.",
        "Change to the lane on the left.",
        "Change lane.",
        "",
    ],
)
def test_another_sentence_is_no_leak(instruction: str) -> None:
    assert leaks([instruction], ["Change to the left lane.", "停车", ""]) == {}


def test_another_number_in_a_long_sentence_is_a_leak() -> None:
    """Augmentation changes numbers: such a pair would be the same sentence."""
    assert leaks(["Please keep our speed at 50 km/h from here on."], ["Keep our speed at 60 km/h from here on."]) != {}


# The data card


def test_the_card_shows_the_tables_of_the_data() -> None:
    card = (DATA / "README.md").read_text(encoding="utf-8")
    _, begin, rest = card.partition("<!-- python -m wayword.models.datacard -->\n")
    table, end, _ = rest.partition("<!-- end of the tables -->")
    assert begin
    assert end
    assert table.strip() == datacard.tables().strip()


def test_the_card_names_every_file() -> None:
    text = (DATA / "README.md").read_text(encoding="utf-8").split("<!-- python")[0]
    for path in (*FILES, *(DATA / "train").glob("*.txt")):
        assert f"`{path.name}`" in text, path
