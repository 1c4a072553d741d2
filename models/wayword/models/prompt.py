"""The translation prompt: knowledge base, in-context examples, vehicle status and the instruction.

The knowledge base is written from the compiler's tables, so that it can't say anything else than they do.
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from importlib.resources import as_file, files

from wayword.compiler import VehicleStatus
from wayword.compiler.vocabulary import ACTIONS, DRIVING_PARAMETERS, Action, Arguments, CommandType
from wayword.models.backend import Message
from wayword.models.dataset import Record, read_records

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
    """The vehicle status in one line; what is unknown is left out."""
    return "; ".join(_status_parts(status))


def _status_parts(status: VehicleStatus) -> Iterator[str]:
    if status.under_way is not None:
        yield "under way" if status.under_way else "parked"
    if status.speed_kmh is not None:
        yield f"speed {status.speed_kmh:.0f} km/h"
    if status.speed_limit_kmh is not None:
        yield f"limit {status.speed_limit_kmh:.0f} km/h"
    if status.lane is not None and status.lanes is not None:
        yield f"lane {status.lane} of {status.lanes}"
    if status.lead_gap_m is not None:
        yield f"car ahead at {status.lead_gap_m:.0f} m"
    if status.traffic_light is not None:
        yield f"light ahead {status.traffic_light}"
    if status.destination is not None:
        yield f"destination {status.destination}"
    if status.waypoints:
        yield f"by way of {', '.join(status.waypoints)}"
    for name, value in status.settings.items():
        yield f"{name} {value}"


@lru_cache(maxsize=1)
def in_context_examples() -> tuple[Record, ...]:
    """The examples that every prompt shows, hand-written, at least one for each action."""
    with as_file(files("wayword.models").joinpath("data/examples.jsonl")) as path:
        return tuple(read_records(path))


def constant_messages(places: Sequence[str]) -> list[Message]:
    """The part of the prompt that stays the same while the map does."""
    messages = [Message("system", f"{_TASK}\n\n{knowledge_base(places)}")]
    for example in in_context_examples():
        messages.append(Message("user", _turn(example.instruction, example.status or VehicleStatus())))
        messages.append(Message("assistant", example.program))
    return messages


def prompt_messages(instruction: str, status: VehicleStatus, places: Sequence[str]) -> list[Message]:
    """The whole prompt for one instruction."""
    return [*constant_messages(places), Message("user", _turn(instruction, status))]


def _turn(instruction: str, status: VehicleStatus) -> str:
    return f"Vehicle: {describe_status(status)}\nPassenger: {instruction}"
