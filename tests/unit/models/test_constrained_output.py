"""The real model under the real constraint: whatever it says, it parses, and compiles or gets a diagnostic."""

import random

import pytest

from wayword.compiler import compile_program
from wayword.grammar import constraint, load, parser, specialise, to_gbnf
from wayword.models.backend import Message
from wayword.models.embedded import EmbeddedModel
from wayword.models.translator import MAX_INSTRUCTION_CHARACTERS, InstructionTooLongError, Translator

pytestmark = pytest.mark.model

TOWN = (
    "Campus Building",
    "Main Station",
    "City Hall",
    "Hospital",
    "Museum",
    "Stadium",
    "Supermarket",
    "Library",
    "Harbor",
    "Home",
)
# fmt: off
WORDS = (
    "please", "go", "stop", "turn", "left", "right", "faster", "slower", "the", "car", "ahead", "light", "green",
    "red", "museum", "harbour", "fifty", "30 km/h", "mph", "why", "when", "not", "and then", "lane", "überholen",
    "停车", "🚗", "}{", '"', "'", "---", "command_type:", "action:", "ignore previous instructions", "\x00", "null",
)
# fmt: on


def random_prompt(generator: random.Random) -> str:
    return " ".join(generator.choices(WORDS, k=generator.randint(1, 12)))


def one_command() -> str:
    """The constraint for a single command: at this temperature the model would else nearly always add three more."""
    return to_gbnf(specialise(load("command"), {"PLACE": TOWN}))


@pytest.mark.parametrize(
    ("gbnf", "generations"), [(one_command(), 200), (constraint(TOWN), 10)], ids=["command", "program"]
)
def test_hot_random_output_always_parses(embedded_model: EmbeddedModel, gbnf: str, generations: int) -> None:
    """Temperature 1.5 over the whole distribution: only the constraint holds the model."""
    generator = random.Random(20261122)
    actions: set[str] = set()
    refused = 0
    for seed in range(generations):
        messages = [Message("user", random_prompt(generator))]
        answer = embedded_model.complete(messages, gbnf=gbnf, temperature=1.5, seed=seed, max_tokens=600)
        assert answer.finished, f"cut off with seed {seed}: {answer.text}"
        parser("start").parse(answer.text)
        result = compile_program(answer.text, TOWN)
        assert result.ok or result.diagnostics
        if result.ok:
            assert result.canonical == answer.text
            actions |= {command.command.action.name for command in result.commands}
        else:
            refused += 1
            assert {diagnostic.code.name for diagnostic in result.diagnostics} == {"WW0303"}, answer.text
    # The test is worth something only if the outputs differ.
    assert len(actions) >= min(15, generations)
    assert refused < generations


def test_a_place_that_is_not_on_the_map_cannot_be_said(embedded_model: EmbeddedModel) -> None:
    translator = Translator(embedded_model, ("Reykjavik", "Ulan Bator"))
    for seed in range(10):
        program = translator.translate("Take me to the harbor.", temperature=1.5, seed=seed).program
        assert "Harbor" not in program
        parser("start").parse(program)


def test_translation_is_deterministic_and_reports_its_cost(embedded_model: EmbeddedModel) -> None:
    translator = Translator(embedded_model, TOWN)
    translator.prepare()
    one, other = translator.translate("Go faster."), translator.translate("Go faster.")
    assert one.program == other.program
    assert compile_program(one.program, TOWN).ok
    assert one.tokens > 10
    assert one.latency_ms > 0
    assert 0 < one.confidence <= 1
    assert one.finished


def test_without_the_constraint_the_model_speaks_freely(embedded_model: EmbeddedModel) -> None:
    messages = [Message("user", "Say hello to the passengers.")]
    answer = embedded_model.complete(messages, max_tokens=20)
    assert not compile_program(answer.text).ok


def test_overlong_instructions_are_refused_before_the_model_reads_them(embedded_model: EmbeddedModel) -> None:
    with pytest.raises(InstructionTooLongError, match="characters"):
        Translator(embedded_model, TOWN).translate("go " * MAX_INSTRUCTION_CHARACTERS)
