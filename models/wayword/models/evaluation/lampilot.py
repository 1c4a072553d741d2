"""LaMPilot-Bench's commands as a test set (Ma et al., CVPR 2024; MIT licence)."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from wayword.compiler.vocabulary import ACTIONS
from wayword.models.dataset import DatasetError, Record

_SIDES = {"left": "left", "right": "right"}
_TURNS = {"il1": "left", "il2": "straight", "il3": "right"}  # from the south approach


def lampilot_records(folder: Path) -> list[Record]:
    """Reads the benchmark's commands with the programs that they mean.

    Args:
        folder: Its folder ``DbLv1``, with one JSON file for each kind of task.

    Raises:
        DatasetError: There is no such folder, or a file in it is not of the benchmark.
    """
    files = sorted(folder.glob("*.json"))
    if not files:
        raise DatasetError(f"no JSON files in {folder}; give the folder DbLv1 of LaMPilot-Bench")
    return [record for file in files for record in _records(file)]


def _records(file: Path) -> list[Record]:
    try:
        task = json.loads(file.read_text(encoding="utf-8"))
        command = _command(task["samples"][0]["eval"])
        sentences = _texts(task["commands"])
    except (ValueError, KeyError, IndexError, TypeError, OSError) as error:
        raise DatasetError(f"{file} is no task of LaMPilot-Bench: {error!r}") from error
    return [
        Record(
            id=f"{file.stem}-{number}",
            instruction=sentence,
            program=command,
            category=command.split("\n", 1)[0].removeprefix("command_type: "),
            tags=(file.stem.rstrip("0123456789"),),
        )
        for number, sentence in enumerate(sentences, start=1)
    ]


def _texts(commands: Any) -> list[str]:
    if not isinstance(commands, list) or not all(isinstance(command, str) for command in commands):
        raise TypeError("commands is no list of texts")
    return commands


def _command(task: Mapping[str, Any]) -> str:
    kind = task["type"]
    if kind in ("ACCEvalbySpeed", "ACCEvalbyDistance"):
        parameter, quantity, unit = (
            ("max_vel", "speed", "m/s") if kind == "ACCEvalbySpeed" else ("following_distance", "distance", "m")
        )
        if quantity in task:
            return _program("SET_PARAM", parameter, f"{task[quantity]:g} {unit}")
        return _program("ADJUST_PARAM", parameter, f"{task['rel_' + quantity]:+g} {unit}")
    if kind == "LaneChangeEval":
        return _program("CHANGE_LANE", "direction", _SIDES[task["direction"]])
    if kind == "OvertakeEval":
        return _program("OVERTAKE", "side", _SIDES[task["direction"]])
    if kind == "IntersectionEval":
        return _program("TURN", "direction", _TURNS[task["direction"][0]])
    if kind == "PullOverEval":
        return _program("PULL_OVER")
    raise ValueError(f"unknown kind of task {kind!r}")


def _program(action: str, name: str = "", value: str = "") -> str:
    parameters = f"parameters:\n  - name: {name}\n    value: {value}\n" if name else ""
    return f"command_type: {ACTIONS[action].command_type}\naction: {action}\n{parameters}"
