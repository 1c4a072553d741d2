"""Scenario files."""

from pathlib import Path

import pytest

from wayword.runtime.scenario import ScenarioError, load_scenario, scenario_names, with_instructions

MINIMAL = """
name: mine
title: My scenario
start: Home
steps:
  - id: t0
    say: Go.
    program: |
      command_type: MISSION
      action: START
"""


def test_the_reference_scenario_has_all_five_categories() -> None:
    scenario = load_scenario("reference")
    types = {(step.program or "").split("\n")[0].removeprefix("command_type: ") for step in scenario.steps}
    assert types == {"INFORMATION", "MISSION", "CONFIG", "COOPERATION", "INTERVENTION"}
    assert [step.id for step in scenario.steps] == ["t0", "t1", "t2", "t3", "t4", "t5"]


def test_a_file_of_ones_own(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(MINIMAL, encoding="utf-8")
    assert load_scenario(str(path)).title == "My scenario"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("action: START", "action: STAR"), "did you mean `START`"),
        (("start: Home", "begin: Home"), "begin: unknown key"),
        (("name: mine", "name: [mine"), "mine.yaml"),
        (("    say: Go.\n", ""), r"steps\.0\.say"),
        (("say: Go.", r'say: "\uD83D"'), "no text"),
        (("say: Go.", "say: Go.\n    when: {aftr_s: 3}"), "did you mean `after_s`"),
        (("name: mine", "name: ../mine"), "name: String should match"),
        (("start: Home", "start: Home\nspeed_checks: [{after: tX, settle_s: 1, at_most_kmh: 30}]"), "step tX"),
        (("steps:", "steps:\n  - {id: t0, say: Stop.}"), "several steps have the id t0"),
        (("steps:", "steps: " + "[" * 5000), "mine.yaml"),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, change: tuple[str, str], message: str) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(MINIMAL.replace(*change), encoding="utf-8")
    with pytest.raises(ScenarioError, match=message):
        load_scenario(str(path))


def test_an_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(ScenarioError, match="reference"):
        load_scenario("no-such-scenario")
    assert "reference" in scenario_names()


def test_instructions_of_ones_own_replace_the_steps() -> None:
    scenario = with_instructions(load_scenario("reference"), ["Go.", "Stop."])
    assert [(step.say, step.program, step.expect) for step in scenario.steps] == [
        ("Go.", None, None),
        ("Stop.", None, None),
    ]
