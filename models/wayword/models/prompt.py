"""The translation prompt: short for tuned weights; with knowledge base, examples and status for any others.

The knowledge base is written from the compiler's tables, so that it can't say anything else than they do.
"""

from collections.abc import Iterator, Sequence
from enum import StrEnum
from functools import lru_cache
from importlib.resources import as_file, files

from wayword.compiler import VehicleStatus
from wayword.compiler.vocabulary import ACTIONS, DRIVING_PARAMETERS, Action, Arguments, CommandType
from wayword.models.backend import Message
from wayword.models.dataset import Record, read_records


class PromptStyle(StrEnum):
    """What a prompt tells the model besides the instruction.

    `TUNED` is what the default model was fine-tuned on: places and vehicle status, nothing else. The others are the
    configurations of the published evaluation, for weights that don't know the language.
    """

    TUNED = "tuned"
    BASELINE = "baseline"  # knowledge base, examples, vehicle status
    NO_STATUS = "no-status"  # knowledge base, examples
    ZERO_SHOT = "zero-shot"  # knowledge base, vehicle status
    KB_ONLY = "kb-only"  # knowledge base

    @property
    def has_examples(self) -> bool:
        """Whether it shows in-context examples."""
        return self in (PromptStyle.BASELINE, PromptStyle.NO_STATUS)

    @property
    def has_status(self) -> bool:
        """Whether it tells the vehicle status."""
        return self in (PromptStyle.TUNED, PromptStyle.BASELINE, PromptStyle.ZERO_SHOT)


_TASK = (
    "You translate what the passenger of an automated vehicle says into a program of the Wayword language. "
    "Answer with the program only: 1 to 4 commands, separated by a line ---."
)


def knowledge_base(places: Sequence[str]) -> str:
    """Writes down the language for a model: every action, parameter, word, unit and place.

    Args:
        places: Names on the loaded map.
    """
    lines = []
    for command_type in CommandType:
        lines.append(f"command_type: {command_type}")
        lines += [_describe(action) for action in ACTIONS.values() if action.command_type is command_type]
    lines.append("Driving parameters:")
    lines += [f"- {parameter.name}: {parameter.meaning}; {parameter.type}" for parameter in DRIVING_PARAMETERS.values()]
    lines.append(f"Places: {', '.join(places)}")
    return "\n".join(lines)


def _describe(action: Action) -> str:
    if action.arguments is Arguments.SETTING:
        parameters = " (one driving parameter with a value or default; or all: default)"
    elif action.arguments is Arguments.ADJUSTMENT:
        parameters = " (one numeric driving parameter: increase | decrease | a signed delta)"
    else:
        listed = [f"{p.name}{'' if p.required else '?'}: {p.type}" for p in action.parameters]
        parameters = f" ({', '.join(listed)})" if listed else ""
    return f"- {action.name}{parameters}: {action.meaning}"


def describe_status(status: VehicleStatus) -> str:
    """The vehicle status in one line."""
    return "; ".join(_status_parts(status))


def _status_parts(status: VehicleStatus) -> Iterator[str]:
    if status.under_way is not None:
        yield "under way" if status.under_way else "parked"
    # Values that instructions refer to are named also where unknown: "ten under the limit" is then a question.
    yield f"speed {_number(status.speed_kmh, 'km/h')}"
    yield f"limit {_number(status.speed_limit_kmh, 'km/h')}"
    if status.lane is not None and status.lanes is not None:
        yield f"lane {status.lane} of {status.lanes}"
    if status.lead_gap_m is not None:
        yield f"car ahead at {_number(status.lead_gap_m, 'm')}"
    if status.traffic_light is not None:
        yield f"light ahead {status.traffic_light}"
    if status.destination is not None:
        yield f"destination {status.destination}"
    if status.waypoints:
        yield f"by way of {', '.join(status.waypoints)}"
    for name, value in status.settings.items():
        yield f"{name} {value}"


def _number(value: float | None, unit: str) -> str:
    return "unknown" if value is None else f"{round(value, 1):g} {unit}"


@lru_cache(maxsize=1)
def in_context_examples() -> tuple[Record, ...]:
    """The examples that every prompt shows, hand-written, at least one for each action."""
    with as_file(files("wayword.models").joinpath("data/examples.jsonl")) as path:
        return tuple(read_records(path))


def constant_messages(places: Sequence[str], style: PromptStyle = PromptStyle.TUNED) -> list[Message]:
    """The beginning of the prompt that stays the same while the map does (and, if tuned, the vehicle status)."""
    if style is PromptStyle.TUNED:
        return _tuned_messages(VehicleStatus(), places)
    messages = [Message("system", f"{_TASK}\n\n{knowledge_base(places)}")]
    for example in in_context_examples() if style.has_examples else ():
        messages.append(Message("user", _turn(example.instruction, example.status or VehicleStatus(), style)))
        messages.append(Message("assistant", example.program))
    return messages


def prompt_messages(
    instruction: str, status: VehicleStatus, places: Sequence[str], style: PromptStyle = PromptStyle.TUNED
) -> list[Message]:
    """The whole prompt for one instruction."""
    if style is PromptStyle.TUNED:
        return [*_tuned_messages(status, places), Message("user", instruction)]
    return [*constant_messages(places, style), Message("user", _turn(instruction, status, style))]


def _tuned_messages(status: VehicleStatus, places: Sequence[str]) -> list[Message]:
    """Places first, the instruction last: what changes most rarely stays longest in the key-value cache."""
    return [Message("system", f"Places: {', '.join(places)}\nVehicle: {describe_status(status)}")]


def _turn(instruction: str, status: VehicleStatus, style: PromptStyle) -> str:
    passenger = f"Passenger: {instruction}"
    return f"Vehicle: {describe_status(status)}\n{passenger}" if style.has_status else passenger
