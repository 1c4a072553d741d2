"""Other quantities: sentence and program stay in step."""

import re
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.programs import join, program
from tests.town import TOWN
from wayword.compiler import compile_program
from wayword.compiler.vocabulary import ACTIONS, DRIVING_PARAMETERS, Quantity
from wayword.models.training.augment.numbers import find_numbers, find_ordinals, say
from wayword.models.training.augment.quantities import UNIT_PHRASES, vary_quantities
from wayword.models.training.corpus import Corpus

SEEDS = range(200)
# An epoch varies three sentences of four; a run sees each sentence a few times.
EPOCHS = 3

# Parameter, unit and whether it is a delta, as the language has them.
KINDS = [
    (parameter.name, unit, delta)
    for parameter in DRIVING_PARAMETERS.values()
    if isinstance(parameter.type, Quantity)
    for unit in parameter.type.units
    for delta in (False, True)
]


def in_program(text: str) -> list[tuple[float, str]]:
    return [(float(number), unit) for number, unit in re.findall(r"value: [+-]?(\d[\d.]*) ?(\S*)\n", text)]


def in_sentence(sentence: str) -> set[float]:
    return {mention.value for mention in (*find_numbers(sentence), *find_ordinals(sentence))}


def unit_after(sentence: str, value: float) -> set[str]:
    """The units that may be meant by what follows a number, the longest phrases first: "m/s^2" is not "m"."""
    phrases = sorted(
        ((phrase, unit) for unit, of_unit in UNIT_PHRASES.items() for phrase in of_unit), key=lambda pair: -len(pair[0])
    )
    for mention in find_numbers(sentence):
        rest = sentence[mention.end :].lstrip(" -").lower()
        if mention.value == pytest.approx(value):
            return {next((unit for phrase, unit in phrases if rest.startswith(phrase)), "none")}
    return set()


@settings(max_examples=400, deadline=None)
@given(
    kind=st.sampled_from(KINDS),
    tenths=st.integers(1, 2000),
    words=st.booleans(),
    hyphen=st.booleans(),
    decrease=st.booleans(),
    rng=st.integers(0, 2**32).map(Random),
)
def test_the_number_and_unit_in_the_program_are_those_in_the_sentence(
    kind: tuple[str, str, bool], tenths: int, words: bool, hyphen: bool, decrease: bool, rng: Random
) -> None:
    name, unit, delta = kind
    sign = ("-" if decrease else "+") if delta else ""
    space = "-" if hyphen and not words else " "
    sentence = f"Make it {say(tenths / 10, rng, words=words)}{space}{rng.choice(UNIT_PHRASES[unit])}, driver."
    before = program("ADJUST_PARAM" if delta else "SET_PARAM", **{name: f"{sign}{tenths / 10:g} {unit}"})
    said, after = vary_quantities(sentence, before, rng)
    ((value, new_unit),) = in_program(after)
    assert [mention.value for mention in find_numbers(said)] == [value]
    assert unit_after(said, value) == {new_unit}
    assert said.startswith("Make it ")
    assert said.endswith(", driver.")
    assert f"value: {sign}{value:g} " in after
    assert {d.code.name for d in compile_program(after).diagnostics} <= {"WW0303"}


def test_all_training_sentences_stay_in_step_with_their_programs() -> None:
    rng = Random(0)
    varied = 0
    for record in Corpus(TOWN).sentences * EPOCHS:
        said, after = vary_quantities(record.instruction, record.program, rng)
        old, new = in_program(record.program), in_program(after)
        was_said, is_said = in_sentence(record.instruction), in_sentence(said)
        assert len(old) == len(new)
        for (old_value, _), (value, _) in zip(old, new, strict=True):
            assert value == old_value or value in is_said, f"{record.instruction} -> {said}"
            assert old_value not in was_said or value in is_said, f"{record.instruction} -> {said}"
        varied += after != record.program
    assert varied > 1000 * EPOCHS


def test_every_unit_is_drawn_for_every_parameter_that_has_it() -> None:
    for name, unit, delta in KINDS:
        sign, action = ("+", "ADJUST_PARAM") if delta else ("", "SET_PARAM")
        of_kind = {u for n, u, d in KINDS if (n, d) == (name, delta) and (u == "s") == (unit == "s")}
        source = program(action, **{name: f"{sign}7 {unit}"})
        drawn = {in_program(vary_quantities(f"7 {unit}", source, Random(seed))[1])[0][1] for seed in SEEDS}
        assert drawn == of_kind, (name, unit)


def test_other_numbers_stay() -> None:
    for seed in SEEDS:
        said, after = vary_quantities("From 90 to 50.", program("SET_PARAM", max_vel="50 km/h"), Random(seed))
        assert 90 in in_sentence(said)
        assert in_program(after)[0][0] in in_sentence(said) - {90}


def test_each_quantity_of_a_program_keeps_its_own_number() -> None:
    source = join(program("SET_PARAM", max_vel="80 km/h"), program("SET_PARAM", following_distance="2 s"))
    for seed in SEEDS:
        said, after = vary_quantities("Drive 80 and stay two seconds behind.", source, Random(seed))
        (speed, _), (headway, unit) = in_program(after)
        first, second = (mention.value for mention in find_numbers(said))
        assert (first, second, unit) == (speed, headway, "s")


@pytest.mark.parametrize(
    ("sentence", "source"),
    [
        ("half a second more", program("ADJUST_PARAM", following_distance="+0.5 s")),
        ("ten under the limit", program("SET_PARAM", max_vel="40 km/h")),
        ("50, yes, 50", program("SET_PARAM", max_vel="50 km/h")),
        ("That's the one we want.", program("TAKE_EXIT", number="1")),
        ("take the next one", program("TAKE_EXIT", number="1")),
        ("Go faster.", program("ADJUST_PARAM", max_vel="increase")),
        ("", program("START")),
    ],
)
def test_what_has_no_number_of_its_own_stays(sentence: str, source: str) -> None:
    for seed in SEEDS:
        assert vary_quantities(sentence, source, Random(seed)) == (sentence, source)


@pytest.mark.parametrize(
    ("sentence", "pattern"),
    [
        ("the third exit", r"the (first|second|third|fourth|fifth|1st|2nd|3rd|4th|5th) exit"),
        ("exit 3", r"exit ([1-5]|one|two|three|four|five)"),
        ("exit one", r"exit ([1-5]|one|two|three|four|five)"),
    ],
)
def test_exits_are_one_to_five_and_ordinals_stay_ordinals(sentence: str, pattern: str) -> None:
    number = "1" if sentence == "exit one" else "3"
    numbers = set()
    for seed in SEEDS:
        said, after = vary_quantities(sentence, program("TAKE_EXIT", number=number), Random(seed))
        assert re.fullmatch(pattern, said)
        ((value, _),) = in_program(after)
        assert in_sentence(said) == {value}
        numbers.add(value)
    assert numbers == {1, 2, 3, 4, 5}


def test_the_tables_of_units_agree_with_the_language() -> None:
    quantities = [parameter.type for parameter in DRIVING_PARAMETERS.values()]
    quantities += [p.type for action in ACTIONS.values() for p in action.parameters if isinstance(p.type, Quantity)]
    assert set(UNIT_PHRASES) == {unit for q in quantities if isinstance(q, Quantity) for unit in q.units}
