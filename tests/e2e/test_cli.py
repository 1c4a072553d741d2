"""The command line as a user or a machine meets it."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from tests.programs import program
from wayword.cli import main
from wayword.grammar import check_gbnf


def run(*arguments: str, stdin: str | None = None) -> Result:
    result = CliRunner().invoke(main, arguments, input=stdin, catch_exceptions=False)
    assert "Traceback" not in result.output
    return result


def test_help_lists_every_command_and_each_has_examples() -> None:
    listed = run("--help").stdout
    for command in ("drive", "translate", "compile", "grammar", "explain"):
        assert command in listed
        assert "Examples:" in run(command, "--help").stdout


def test_python_dash_m() -> None:
    done = subprocess.run([sys.executable, "-m", "wayword", "--version"], capture_output=True, text=True, check=True)
    assert "wayword" in done.stdout


def test_compile_prints_instructions(tmp_path: Path) -> None:
    path = tmp_path / "trip.yaml"
    path.write_text(program("SET_PARAM", max_vel="90 km/h"), encoding="utf-8")
    result = run("compile", str(path))
    assert result.exit_code == 0
    assert result.stdout.splitlines() == [
        "; 1: SET_PARAM max_vel=90 km/h, line 1",
        "DO      set_parameter name=max_vel, value=25 m/s",
    ]


def test_compile_json_from_standard_input() -> None:
    result = run("compile", "-", "--json", stdin=program("TURN", direction="left"))
    answer = json.loads(result.stdout)
    assert result.exit_code == 0
    assert answer["ok"] is True
    assert answer["diagnostics"] == []
    assert [instruction["opcode"] for instruction in answer["instructions"]] == ["REQUIRE", "DO", "AWAIT"]


def test_compile_reports_errors_with_code_and_place() -> None:
    source = program("SET_PARAM", max_vel="250 km/h")
    answer = json.loads(run("compile", "-", "--json", stdin=source).stdout)
    assert answer["ok"] is False
    assert answer["instructions"] == []
    (diagnostic,) = answer["diagnostics"]
    assert (diagnostic["code"], diagnostic["severity"]) == ("WW0303", "error")
    assert (diagnostic["line"], diagnostic["column"]) == (5, 12)
    human = run("compile", "-", stdin=source)
    assert human.exit_code == 1
    assert "5 to 130 km/h" in human.stderr


def test_places_are_checked_against_the_map() -> None:
    known = run("compile", "-", "--map", "town", stdin=program("SET_DESTINATION", destination="Harbor"))
    unknown = run("compile", "-", "--map", "town", stdin=program("SET_DESTINATION", destination="Atlantis"))
    assert (known.exit_code, unknown.exit_code) == (0, 1)


@pytest.mark.parametrize(
    "arguments",
    [
        ("compile", "no-such-file.yaml"),
        ("compile", "-", "--map", "no-such-map"),
        ("grammar", "--map", "no-such-map"),
        ("grammar", "--format", "no-such-format"),
        ("translate", "  "),
        ("translate", "Go.", "--model", "no-such-model.gguf"),
        ("translate", "Go.", "--status", '{"speed": 3}'),
        ("translate", "stop \udcff now"),
        ("drive", "--scenario", "no-such-scenario"),
        ("drive", "--programs", "--text", "Go."),
        ("drive", "--runs", "0"),
        ("drive", "--text", ""),
        ("drive", "--jobs", "2"),
        ("explain", "WW9999"),
        ("no-such-command",),
    ],
)
def test_bad_input_gets_a_message_and_status_2(arguments: tuple[str, ...]) -> None:
    result = run(*arguments, stdin="")
    assert result.exit_code == 2
    assert result.stdout == ""
    assert len(result.stderr) > 20


def test_bad_input_with_json_is_one_json_object() -> None:
    result = run("compile", "no-such-file.yaml", "--json")
    assert result.exit_code == 2
    assert "no-such-file.yaml" in json.loads(result.stdout)["error"]


@pytest.mark.parametrize("arguments", [("drive", "--runs", "0"), ("compile",), ("no-such-command",)])
def test_bad_usage_with_json_is_one_json_object_too(arguments: tuple[str, ...]) -> None:
    result = run(*arguments, "--json")
    assert result.exit_code == 2
    assert json.loads(result.stdout)["error"]


@pytest.mark.parametrize("prefix", ["", "\ufeff"])
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_files_and_standard_input_are_read_alike(tmp_path: Path, prefix: str, newline: str) -> None:
    content = (prefix + program("TURN", direction="left").replace("\n", newline)).encode()
    path = tmp_path / "trip.yaml"
    path.write_bytes(content)
    piped = subprocess.run([sys.executable, "-m", "wayword", "compile", "-"], input=content, capture_output=True)
    assert run("compile", str(path)).exit_code == piped.returncode == 0


def test_what_is_no_program_at_all_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "trip.yaml"
    for content, words in ((b"\xff\xfe", "UTF-8"), (b"x" * 100_000, "at most 4 commands")):
        path.write_bytes(content)
        result = run("compile", str(path))
        assert result.exit_code == 2
        assert words in result.stderr
    assert run("compile", str(tmp_path)).exit_code == 2


SCENARIO = """
name: mine
title: "50 [/b] $ and $ more"
start: Home
destination: Harbor
tail_s: 0
steps:
  - id: t0
    say: "What does $x$ [/] cost,\\u2028 please?"
    program: |
      command_type: OUT_OF_SCOPE
      action: REJECT
      parameters:
        - name: reason
          value: unrelated
    expect: refused
"""


def test_a_scenario_with_awkward_words_is_driven_and_drawn(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(SCENARIO, encoding="utf-8")
    result = run("drive", "--programs", "--scenario", str(path), "--out", str(tmp_path / "o[/x]"))
    assert result.exit_code == 0
    assert "$x$ [/] cost" in result.stdout


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("action: REJECT", "action: STAR"), "START"),
        (("reason\n          value: unrelated", "reason\n          value: bored"), "unrelated"),
        (("start: Home", "start: Atlantis"), "Atlantis"),
        (("destination: Harbor", "destination: Atlantis"), "Atlantis"),
    ],
)
def test_a_scenario_that_makes_no_sense_is_refused(tmp_path: Path, change: tuple[str, str], words: str) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(SCENARIO.replace(*change), encoding="utf-8")
    result = run("drive", "--programs", "--scenario", str(path), "--out", str(tmp_path / "out"))
    assert result.exit_code == 2
    assert words in result.stderr


def test_gold_programs_must_name_places_of_the_map(tmp_path: Path) -> None:
    elsewhere = """command_type: MISSION
      action: SET_DESTINATION
      parameters:
        - name: destination
          value: Atlantis
"""
    begin, end = SCENARIO.index("command_type"), SCENARIO.index("    expect")
    path = tmp_path / "mine.yaml"
    path.write_text(SCENARIO[:begin] + elsewhere + SCENARIO[end:], encoding="utf-8")
    result = run("drive", "--programs", "--scenario", str(path), "--out", str(tmp_path / "out"))
    assert result.exit_code == 2
    assert "Atlantis" in result.stderr


def test_an_output_folder_that_cannot_be_made_is_refused_before_the_drive(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    result = run("drive", "--programs", "--out", str(tmp_path / "file"))
    assert result.exit_code == 2
    assert "file" in result.stderr


def test_a_trip_that_fails_ends_with_status_1(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(SCENARIO.replace("expect: refused", "expect: succeeded"), encoding="utf-8")
    result = run("drive", "--programs", "--scenario", str(path), "--json", "--out", str(tmp_path / "out"))
    assert result.exit_code == 1
    assert "expected succeeded, got REJECT refused" in json.loads(result.stdout)["details"][0]["failures"][0]


def test_grammar_prints_a_linted_constraint_with_the_places_of_the_map() -> None:
    gbnf = run("grammar", "--format", "gbnf", "--map", "town").stdout
    check_gbnf(gbnf)
    assert "root ::=" in gbnf
    assert "Library" in gbnf
    assert run("grammar", "--format", "lark").stdout.startswith("//")


def test_explain() -> None:
    assert "bounds" in run("explain", "ww0303").stdout
    assert "WW0101" in run("explain").stdout
    assert "WW0303" in json.loads(run("explain", "--json").stdout)


def test_drive_json(tmp_path: Path) -> None:
    result = run("drive", "--scenario", "reference", "--programs", "--seed", "3", "--json", "--out", str(tmp_path))
    answer = json.loads(result.stdout)
    assert result.exit_code == 0
    assert answer["runs"] == answer["successes"] == 1
    assert answer["success_rate"] == 1.0
    assert (answer["collisions"], answer["red_lights_run"]) == (0, 0)
    assert answer["outcomes"] == {"succeeded": 6}
    (detail,) = answer["details"]
    assert [said["id"] for said in detail["instructions"]] == ["t0", "t1", "t2", "t3", "t4", "t5"]
    assert all(said["outcomes"] and said["feedback"] for said in detail["instructions"])
    assert all(Path(plot).is_file() for plot in detail["plots"])
    folder = tmp_path / "reference" / "seed-3"
    assert {path.name for path in folder.iterdir()} == {"log.jsonl", "velocity.png", "map.png"}


def test_drive_shows_every_stage(tmp_path: Path) -> None:
    shown = run("drive", "--programs", "--out", str(tmp_path)).stdout
    for words in ("Go straight instead.", "action: TURN", "AWAIT", "succeeded", "We went straight on", "velocity.png"):
        assert words in shown


@pytest.mark.model
def test_translate_json_with_the_real_model() -> None:
    result = run("translate", "--json", "No faster than fifty, please.")
    answer = json.loads(result.stdout)
    assert {"program", "latency_ms", "tokens", "forced_tokens", "confidence"} <= answer.keys()
    compiled = run("compile", "-", stdin=answer["program"])
    assert compiled.exit_code in (0, 1)
    assert result.exit_code == compiled.exit_code


@pytest.mark.model
def test_drive_with_the_real_model_reports_mistranslations_after_a_complete_run(tmp_path: Path) -> None:
    result = run("drive", "--json", "--out", str(tmp_path))
    answer = json.loads(result.stdout)
    (detail,) = answer["details"]
    assert detail["failures"] == []
    assert sum(answer["outcomes"].values()) == 6
    assert result.exit_code == (1 if detail["mistranslated"] else 0)
    assert answer["successes"] == (0 if detail["mistranslated"] else 1)
