"""The prompt says what the tables say."""

import pytest

from wayword.compiler import VehicleStatus, compile_program
from wayword.compiler.vocabulary import ACTIONS, DRIVING_PARAMETERS, Choice
from wayword.models.prompt import (
    PromptStyle,
    constant_messages,
    describe_status,
    in_context_examples,
    knowledge_base,
    prompt_messages,
)

TOWN = ("Harbor", "Home", "Library", "Museum")


def test_the_knowledge_base_names_every_action_parameter_word_and_place() -> None:
    text = knowledge_base(TOWN)
    for action in ACTIONS.values():
        assert f"- {action.name}" in text
        assert action.meaning in text
        for parameter in action.parameters:
            assert parameter.name in text
            if isinstance(parameter.type, Choice):
                assert str(parameter.type) in text
    for driving_parameter in DRIVING_PARAMETERS.values():
        assert f"- {driving_parameter.name}: {driving_parameter.meaning}; {driving_parameter.type}" in text
    assert "Places: Harbor, Home, Library, Museum" in text


def test_every_action_has_an_in_context_example_in_canonical_form() -> None:
    shown = set()
    for example in in_context_examples():
        result = compile_program(example.program, TOWN)
        assert result.ok, example
        assert result.canonical == example.program
        assert example.category == example.program.split("\n")[0].removeprefix("command_type: ")
        shown |= {command.command.action.name for command in result.commands}
    assert shown == set(ACTIONS)


# What each style tells besides the instruction: knowledge base, examples, vehicle status.
TELLS = {
    PromptStyle.TUNED: (False, False, True),
    PromptStyle.BASELINE: (True, True, True),
    PromptStyle.NO_STATUS: (True, True, False),
    PromptStyle.ZERO_SHOT: (True, False, True),
    PromptStyle.KB_ONLY: (True, False, False),
}
STATUS = VehicleStatus(speed_kmh=42.0, under_way=True, traffic_light="red", destination="Harbor")


@pytest.mark.parametrize("style", PromptStyle)
def test_each_style_tells_what_it_should_and_nothing_else(style: PromptStyle) -> None:
    messages = prompt_messages("Go faster.", STATUS, TOWN, style)
    text = "\n".join(message.content for message in messages)
    has_knowledge, has_examples, has_status = TELLS[style]
    assert (style.has_examples, style.has_status) == (has_examples, has_status)
    assert (knowledge_base(TOWN) in text) is has_knowledge
    assert ("SET_PARAM" in text) is has_knowledge
    assert (describe_status(STATUS) in text) is has_status
    assert ("Vehicle: " in text) is has_status
    assert ("42" in text) is has_status
    for example in in_context_examples():
        assert any(message.content.endswith(example.instruction) for message in messages) is has_examples
        assert any(message.content == example.program for message in messages) is has_examples
    assert text.count(f"Places: {', '.join(TOWN)}") == 1


@pytest.mark.parametrize("style", PromptStyle)
def test_the_turns_are_in_order_and_the_instruction_is_last(style: PromptStyle) -> None:
    *before, last = prompt_messages("Go faster.", STATUS, TOWN, style)
    examples = 2 * len(in_context_examples()) if style.has_examples else 0
    assert [message.role for message in before] == ["system", *["user", "assistant"] * (examples // 2)]
    assert last.role == "user"
    assert last.content.endswith("Go faster.")
    assert sum("Go faster." in message.content for message in before) == 0


@pytest.mark.parametrize("style", PromptStyle)
def test_the_prompt_begins_with_its_constant_part(style: PromptStyle) -> None:
    """Read ahead of the first instruction: what differs must come after it, or the model reads all of it again."""
    beginning = constant_messages(TOWN, style)
    if style is PromptStyle.TUNED:  # the status has its place amid the short prompt
        assert prompt_messages("Go.", VehicleStatus(), TOWN, style)[:-1] == beginning
        one, other = beginning[0].content, prompt_messages("Go.", STATUS, TOWN, style)[0].content
        assert one.split("Vehicle: ")[0] == other.split("Vehicle: ")[0]
    else:
        assert prompt_messages("Go.", STATUS, TOWN, style)[:-1] == beginning


def test_the_tuned_prompt_is_places_status_and_instruction() -> None:
    system, user = prompt_messages("Go faster.", STATUS, TOWN)
    assert system.content == (
        "Places: Harbor, Home, Library, Museum\n"
        "Vehicle: under way; speed 42 km/h; limit 50 km/h; lane 1 of 2; light ahead red; destination Harbor"
    )
    assert user.content == "Go faster."


def test_examples_are_shown_with_their_own_status() -> None:
    shown = [m.content for m in constant_messages(TOWN, PromptStyle.BASELINE) if m.role == "user"]
    for example, turn in zip(in_context_examples(), shown, strict=True):
        status = describe_status(example.status or VehicleStatus())
        assert turn == f"Vehicle: {status}\nPassenger: {example.instruction}"


def test_speed_and_limit_are_named_even_where_unknown_and_other_unknown_parts_left_out() -> None:
    assert describe_status(VehicleStatus()) == "parked; speed 0 km/h; limit 50 km/h; lane 1 of 2"
    nothing = VehicleStatus(speed_kmh=None, speed_limit_kmh=None, lane=None, under_way=None)
    assert describe_status(nothing) == "speed unknown; limit unknown"
    assert describe_status(nothing.model_copy(update={"lane": 1, "lanes": None})) == "speed unknown; limit unknown"


def test_a_whole_status() -> None:
    status = VehicleStatus(
        speed_kmh=41.26,
        speed_limit_kmh=30,
        lane=2,
        lanes=3,
        lead_gap_m=12.04,
        traffic_light="green",
        destination="Home",
        waypoints=("Museum", "Library"),
        under_way=True,
        settings={"max_vel": "40 km/h", "driving_style": "calm"},
    )
    assert describe_status(status) == (
        "under way; speed 41.3 km/h; limit 30 km/h; lane 2 of 3; car ahead at 12 m; light ahead green; "
        "destination Home; by way of Museum, Library; max_vel 40 km/h; driving_style calm"
    )
