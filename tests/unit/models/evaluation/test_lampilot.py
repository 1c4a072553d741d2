"""A benchmark in LaMPilot-Bench's form: its commands and the programs that they mean."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.programs import program
from tests.town import TOWN
from wayword.compiler import compile_program
from wayword.models import DatasetError
from wayword.models.evaluation.lampilot import lampilot_records

TASKS = {
    "abs_speed10": ({"type": "ACCEvalbySpeed", "speed": 10}, program("SET_PARAM", max_vel="10 m/s")),
    "dec_rel_speed4": ({"type": "ACCEvalbySpeed", "rel_speed": -4}, program("ADJUST_PARAM", max_vel="-4 m/s")),
    "inc_rel_speed2": ({"type": "ACCEvalbySpeed", "rel_speed": 2.5}, program("ADJUST_PARAM", max_vel="+2.5 m/s")),
    "abs_dis15": ({"type": "ACCEvalbyDistance", "distance": 15}, program("SET_PARAM", following_distance="15 m")),
    "dec_rel_dis13": (
        {"type": "ACCEvalbyDistance", "rel_distance": -13},
        program("ADJUST_PARAM", following_distance="-13 m"),
    ),
    "inc_rel_dis8": (
        {"type": "ACCEvalbyDistance", "rel_distance": 8},
        program("ADJUST_PARAM", following_distance="+8 m"),
    ),
    "left_lc": ({"type": "LaneChangeEval", "direction": "left"}, program("CHANGE_LANE", direction="left")),
    "right_overtake": ({"type": "OvertakeEval", "direction": "right"}, program("OVERTAKE", side="right")),
    "turn_left": ({"type": "IntersectionEval", "direction": ["il1", "o1", 0]}, program("TURN", direction="left")),
    "go_straight": ({"type": "IntersectionEval", "direction": ["il2", "o2", 0]}, program("TURN", direction="straight")),
    "turn_right": ({"type": "IntersectionEval", "direction": ["il3", "o3", 0]}, program("TURN", direction="right")),
    "pull_over": ({"type": "PullOverEval"}, program("PULL_OVER")),
}


def write(folder: Path, name: str, task: object, commands: object = ("Do it.", "Do it, please.")) -> None:
    content = {"commands": commands, "samples": [{"config": {}, "eval": task, "seed": 1}]}
    (folder / f"{name}.json").write_text(json.dumps(content), encoding="utf-8")


@pytest.mark.parametrize("name", list(TASKS))
def test_each_kind_of_task_has_its_program(tmp_path: Path, name: str) -> None:
    task, expected = TASKS[name]
    write(tmp_path, name, task)
    one, other = lampilot_records(tmp_path)
    assert one.program == other.program == expected
    assert compile_program(expected, TOWN).canonical == expected
    assert (one.instruction, other.instruction) == ("Do it.", "Do it, please.")
    assert one.category == expected.split("\n")[0].removeprefix("command_type: ")


def test_all_files_are_read_and_the_numbers_are_put_aside_in_the_tags(tmp_path: Path) -> None:
    for name, (task, _) in TASKS.items():
        write(tmp_path, name, task)
    (tmp_path / "config_list.txt").write_text("not read", encoding="utf-8")
    records = lampilot_records(tmp_path)
    assert len(records) == len({record.id for record in records}) == 2 * len(TASKS)
    assert {tag for record in records for tag in record.tags} == {name.rstrip("0123456789") for name in TASKS}
    assert [record.id for record in records][:2] == ["abs_dis15-1", "abs_dis15-2"]


BROKEN: dict[str, Any] = {
    "cut off": '{"commands": ["Go',
    "no UTF-8": b"\xff\xfe",
    "a list": "[]",
    "no samples": '{"commands": ["Go."], "samples": []}',
    "no commands": '{"samples": [{"eval": {"type": "PullOverEval"}}]}',
    "no type": '{"commands": ["Go."], "samples": [{"eval": {}}]}',
    "unknown type": '{"commands": ["Go."], "samples": [{"eval": {"type": "FlyEval"}}]}',
    "no speed": '{"commands": ["Go."], "samples": [{"eval": {"type": "ACCEvalbySpeed"}}]}',
    "speed in words": '{"commands": ["Go."], "samples": [{"eval": {"type": "ACCEvalbySpeed", "speed": "ten"}}]}',
    "unknown turn": '{"commands": ["Go."], "samples": [{"eval": {"type": "IntersectionEval", "direction": ["il9"]}}]}',
    "commands no list": '{"commands": 3, "samples": [{"eval": {"type": "PullOverEval"}}]}',
    "unknown side": '{"commands": ["Go."], "samples": [{"eval": {"type": "LaneChangeEval", "direction": "up"}}]}',
    "one text": '{"commands": "Go.", "samples": [{"eval": {"type": "PullOverEval"}}]}',
}


@pytest.mark.parametrize("content", BROKEN.values(), ids=BROKEN)
def test_a_broken_file_is_named(tmp_path: Path, content: str | bytes) -> None:
    write(tmp_path, "pull_over", {"type": "PullOverEval"})
    (tmp_path / "turn_up.json").write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(DatasetError, match=r"turn_up\.json is no task of LaMPilot-Bench"):
        lampilot_records(tmp_path)


def test_a_folder_without_tasks_is_refused_with_advice(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    for folder in (tmp_path, tmp_path / "none", tmp_path / "file"):
        with pytest.raises(DatasetError, match="give the folder DbLv1"):
            lampilot_records(folder)
