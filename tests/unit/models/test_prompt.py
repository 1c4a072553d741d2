"""The prompt says what the tables say."""

from wayword.compiler import VehicleStatus, compile_program
from wayword.compiler.vocabulary import ACTIONS, DRIVING_PARAMETERS, Choice
from wayword.models.prompt import (
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


def test_the_prompt_begins_with_its_constant_part_and_ends_with_status_and_instruction() -> None:
    status = VehicleStatus(speed_kmh=42.0, under_way=True, traffic_light="red", destination="Harbor")
    messages = prompt_messages("Go faster.", status, TOWN)
    assert messages[:-1] == constant_messages(TOWN)
    assert "speed 42 km/h" in messages[-1].content
    assert "light ahead red" in messages[-1].content
    assert messages[-1].content.endswith("Passenger: Go faster.")


def test_unknown_parts_of_the_status_are_left_out() -> None:
    assert describe_status(VehicleStatus()) == "parked; speed 0 km/h; limit 50 km/h; lane 1 of 2"
    nothing = VehicleStatus(speed_kmh=None, speed_limit_kmh=None, lane=None, under_way=None)
    assert describe_status(nothing) == ""
