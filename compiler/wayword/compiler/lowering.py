"""Lowers well-typed commands to executor instructions.

What a command requires here are the facts that make it meaningful at all; whether the vehicle does it at this moment
(gaps, distances, committed manoeuvres) is the vehicle's own answer to the ``DO``.
"""

from collections.abc import Callable
from dataclasses import dataclass

from wayword.compiler.instructions import Await, Do, Instruction, Operand, Operands, Require, Scalar, Symbol
from wayword.compiler.syntax import Command, Measurement, Program, Value
from wayword.compiler.units import Dimension
from wayword.compiler.values import DEFAULT
from wayword.compiler.vocabulary import (
    DRIVING_PARAMETERS,
    DRIVING_STYLES,
    DrivingParameter,
    Measure,
    Place,
)

# Time-outs in simulated seconds. A manoeuvre at a junction may have to wait through more than one red light.
ENGAGE_S = 10.0
STANDSTILL_S = 60.0
LANE_CHANGE_S = 60.0
OVERTAKE_S = 120.0
JUNCTION_S = 240.0
PULL_OVER_S = 120.0
YIELD_S = 60.0


@dataclass(frozen=True, slots=True)
class LoweredCommand:
    """A command with the instructions that it became."""

    command: Command
    instructions: tuple[Instruction, ...]


def lower(program: Program) -> tuple[LoweredCommand, ...]:
    """Lowers every command of a well-typed program."""
    return tuple(LoweredCommand(command, tuple(lower_command(command))) for command in program.commands)


def lower_command(command: Command) -> list[Instruction]:
    """Lowers one well-typed command."""
    if command.action.name == "SET_PARAM":
        return _set_parameter(command)
    if command.action.name == "ADJUST_PARAM":
        return _adjust_parameter(command)
    return _TEMPLATES[command.action.name](_operands(command))


def _operands(command: Command) -> Operands:
    places = {parameter.name for parameter in command.action.parameters if isinstance(parameter.type, Place)}
    return tuple(
        ("place", Symbol(str(argument.value), is_place=True))
        if argument.name in places
        else (argument.name, _operand(argument.value))
        for argument in command.arguments
    )


def _operand(value: Value) -> Operand:
    if isinstance(value, Measurement):
        return Scalar(value.si, value.unit.dimension.si_unit)
    return Symbol(value.text)


def _effect(name: str) -> Callable[[Operands], list[Instruction]]:
    return lambda operands: [Do(name, operands)]


def _mission(name: str, requirement: str) -> Callable[[Operands], list[Instruction]]:
    return lambda operands: [Require(requirement, operands), Do(name, operands)]


def _manoeuvre(name: str, condition: str, timeout_s: float) -> Callable[[Operands], list[Instruction]]:
    return lambda operands: [
        Require("under_way"),
        Do(name, operands),
        Await(condition, operands, timeout_s=timeout_s),
    ]


_UNDER_WAY = Require("under_way")

_TEMPLATES: dict[str, Callable[[Operands], list[Instruction]]] = {
    "QUERY": _effect("answer"),
    "SET_DESTINATION": _mission("set_destination", "place_reachable"),
    "ADD_WAYPOINT": _mission("add_waypoint", "place_reachable"),
    "REMOVE_WAYPOINT": _mission("remove_waypoint", "waypoint_planned"),
    "START": lambda _: [Require("destination_known"), Do("start"), Await("autonomous", timeout_s=ENGAGE_S)],
    "STOP": lambda _: [Do("stop"), Await("standstill", timeout_s=STANDSTILL_S)],
    "CHANGE_LANE": lambda operands: [
        _UNDER_WAY,
        Require("lane_exists", operands),
        Do("change_lane", operands),
        Await("lane_changed", operands, timeout_s=LANE_CHANGE_S),
    ],
    "OVERTAKE": _manoeuvre("overtake", "leader_passed", OVERTAKE_S),
    "TURN": _manoeuvre("turn", "junction_passed", JUNCTION_S),
    "TAKE_EXIT": _manoeuvre("take_exit", "exit_taken", JUNCTION_S),
    "PULL_OVER": _manoeuvre("pull_over", "standstill", PULL_OVER_S),
    "KEEP_LANE": _effect("keep_lane"),
    "GIVE_WAY": _manoeuvre("give_way", "way_given", YIELD_S),
    "OVERRIDE_TRAFFIC_LIGHT": _mission("override_traffic_light", "traffic_light_seen"),
    "OVERRIDE_SPEED_LIMIT": _effect("override_speed_limit"),
    "IGNORE_OBJECT": _mission("ignore_object", "object_perceived"),
    "REPORT_OBJECT": _effect("report_object"),
    "PROCEED": lambda _: [Require("waiting"), Do("proceed"), Await("moving", timeout_s=YIELD_S)],
    "EMERGENCY_STOP": lambda _: [Do("emergency_stop"), Await("standstill", timeout_s=STANDSTILL_S)],
    "REJECT": _effect("reject"),
    "CLARIFY": _effect("ask"),
}


def _set_parameter(command: Command) -> list[Instruction]:
    argument = command.arguments[0]
    if argument.name == "all":
        return [Do("reset_parameters")]
    operand = (
        _default(DRIVING_PARAMETERS[argument.name]) if str(argument.value) == DEFAULT else _operand(argument.value)
    )
    instructions: list[Instruction] = []
    if (
        isinstance(operand, Scalar)
        and argument.name == "following_distance"
        and operand.unit == Dimension.LENGTH.si_unit
    ):
        # A length is only a safe distance at the speed it is held at (language.md section 3).
        instructions.append(Require("headway_in_bounds", (("length", operand),)))
    instructions.append(_set(argument.name, operand))
    if argument.name == "driving_style":
        presets = DRIVING_STYLES[str(operand)]
        instructions += [_set(name, _scalar(measure)) for name, measure in presets.items()]
    return instructions


def _adjust_parameter(command: Command) -> list[Instruction]:
    argument = command.arguments[0]
    delta = _operand(argument.value)
    if isinstance(delta, Symbol):
        step = DRIVING_PARAMETERS[argument.name].step
        assert step is not None, "the checker lets only numeric parameters through"
        size = _scalar(step)
        delta = Scalar(size.value if delta.text == "increase" else -size.value, size.unit)
    return [Do("adjust_parameter", (("name", Symbol(argument.name)), ("delta", delta)))]


def _set(name: str, value: Operand) -> Do:
    return Do("set_parameter", (("name", Symbol(name)), ("value", value)))


def _default(parameter: DrivingParameter) -> Operand:
    return _scalar(parameter.default) if isinstance(parameter.default, Measure) else Symbol(parameter.default)


def _scalar(measure: Measure) -> Scalar:
    return Scalar(measure.si, measure.dimension.si_unit)
