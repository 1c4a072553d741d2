"""The tables and the grammar say the same."""

from itertools import product

from lark import UnexpectedInput

from tests.programs import program
from wayword.compiler import compile_program
from wayword.compiler.vocabulary import (
    ACTIONS,
    DRIVING_PARAMETERS,
    Action,
    Arguments,
    Choice,
    Place,
    Quantity,
    ValueType,
)
from wayword.grammar import parser

ALL_UNITS = ("km/h", "mph", "m/s", "s", "m", "ft", "m/s^2")


def in_grammar(source: str) -> bool:
    try:
        parser("start").parse(source)
    except UnexpectedInput:
        return False
    return True


def samples(kind: ValueType, sign: str = "") -> set[str]:
    """Values of a type, in canonical form."""
    if isinstance(kind, Choice):
        return set(kind.options)
    if isinstance(kind, Place):
        return {"Some Place"}
    return {f"{sign}7 {unit}" for unit in kind.units}


WORDS = {option for p in DRIVING_PARAMETERS.values() if isinstance(p.type, Choice) for option in p.type.options}
CANDIDATES = (
    {f"{sign}7 {unit}" for sign, unit in product(("", "+", "-"), ALL_UNITS)}
    | {"default", "increase", "decrease", "7", "Some Place"}
    | WORDS
    | {
        option
        for a in ACTIONS.values()
        for p in a.parameters
        if isinstance(p.type, Choice)
        for option in p.type.options
    }
)


def allowed(action: Action, name: str) -> set[str]:
    """The candidate values that the tables allow, leaving bounds aside."""
    if action.arguments is Arguments.OWN:
        return samples(next(p.type for p in action.parameters if p.name == name))
    parameter = DRIVING_PARAMETERS.get(name)
    if action.arguments is Arguments.SETTING:
        return {"default"} | (samples(parameter.type) if parameter else set())
    assert parameter is not None
    if isinstance(parameter.type, Choice):
        return set()
    return {"increase", "decrease"} | samples(parameter.type, "+") | samples(parameter.type, "-")


def names(action: Action) -> list[str]:
    if action.arguments is Arguments.OWN:
        return [p.name for p in action.parameters]
    return [*DRIVING_PARAMETERS, *(["all"] if action.arguments is Arguments.SETTING else [])]


def test_the_grammar_allows_exactly_the_values_of_the_tables() -> None:
    for action in ACTIONS.values():
        required = {p.name: min(samples(p.type)) for p in action.parameters if p.required}
        for name in names(action):
            found = {value for value in CANDIDATES if in_grammar(program(action.name, **{**required, name: value}))}
            expected = allowed(action, name)
            if action.arguments is Arguments.OWN and isinstance(
                next(p.type for p in action.parameters if p.name == name), Place
            ):
                # any word is a well-formed place name
                found &= {"Some Place"}
            assert found == expected, f"{action.name} {name}"


def test_the_grammar_asks_for_the_same_parameters_as_the_tables() -> None:
    for action in ACTIONS.values():
        optional_only = action.arguments is Arguments.OWN and not any(p.required for p in action.parameters)
        assert in_grammar(program(action.name)) is optional_only
        assert compile_program(program(action.name)).ok is optional_only


def test_an_action_has_one_command_type_in_the_grammar() -> None:
    for action in ACTIONS.values():
        required = {p.name: min(samples(p.type)) for p in action.parameters if p.required}
        if action.arguments is not Arguments.OWN:
            required = {"max_vel": "default" if action.arguments is Arguments.SETTING else "increase"}
        source = program(action.name, **required)
        assert in_grammar(source)
        for other in {a.command_type for a in ACTIONS.values()} - {action.command_type}:
            assert not in_grammar(source.replace(f"command_type: {action.command_type}", f"command_type: {other}"))


def test_defaults_lie_within_their_bounds() -> None:
    for name, parameter in DRIVING_PARAMETERS.items():
        assert isinstance(parameter.type, Choice | Quantity)
        assert compile_program(program("SET_PARAM", **{name: str(parameter.default)})).ok
