"""The reference scenario on gold programs, and that a run is the same every time."""

import subprocess
import sys
from pathlib import Path

import pytest

from wayword.runtime.outcome import Outcome
from wayword.runtime.plots import plot_map, plot_velocity
from wayword.runtime.recording import Event, read_log
from wayword.runtime.result import RunResult
from wayword.runtime.scenario import load_scenario
from wayword.runtime.sweep import run_gold, sweep_gold

SEEDS = range(6)


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> dict[int, RunResult]:
    folder = tmp_path_factory.mktemp("reference")
    return {result.seed: result for result in sweep_gold(load_scenario("reference"), SEEDS, folder, processes=2)}


def events(result: RunResult, kind: str) -> list[Event]:
    return [event for event in read_log(result.log) if event["event"] == kind]


def states(log: Path) -> list[Event]:
    return [event for event in read_log(log) if event["event"] == "state"]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_trip_succeeds(results: dict[int, RunResult], seed: int) -> None:
    result = results[seed]
    assert result.failures == []
    assert result.success
    assert (result.collisions, result.red_lights_run) == (0, 0)
    assert result.outcomes == {Outcome.SUCCEEDED: 6}


@pytest.mark.parametrize("seed", SEEDS)
def test_what_the_car_did_is_what_was_said(results: dict[int, RunResult], seed: int) -> None:
    """Judged from the log alone, apart from the scenario's own verdict."""
    said = {event["id"]: event["t"] for event in events(results[seed], "instruction")}
    log = states(results[seed].log)

    def between(start: float, end: float) -> list[Event]:
        return [state for state in log if start <= state["t"] <= end]

    assert all(state["speed"] == 0 for state in between(0, said["t0"]))
    waiting = between(said["t1"] - 1.5, said["t1"] - 0.1)
    assert all((state["light"], state["true_light"]) == ("red", "green") for state in waiting)
    assert all(state["speed"] < 0.2 for state in waiting)
    assert max(state["speed"] for state in between(said["t1"], said["t1"] + 6)) > 3.0
    straight_on = between(said["t3"], said["t4"])
    assert {"Market Square"} <= {state["road"] for state in straight_on}
    assert all(abs(state["heading"]) < 0.3 for state in straight_on), "the car went east all the way"
    assert straight_on[-1]["road"] == "Main Street"
    assert max(state["speed"] for state in between(said["t4"] + 6, said["t5"])) <= 31 / 3.6
    assert log[-1]["speed"] == 0
    assert log[-1]["lane"] is not None, "the car stands in a lane, not in a junction"


def test_the_log_holds_every_stage_of_every_instruction(results: dict[int, RunResult]) -> None:
    for kind in ("instruction", "compilation", "outcome", "feedback"):
        assert [event["id"] for event in events(results[0], kind)] == ["t0", "t1", "t2", "t3", "t4", "t5"]
    (end,) = events(results[0], "end")
    assert end["success"] is True


def test_the_answer_to_the_question_is_true(results: dict[int, RunResult]) -> None:
    for result in results.values():
        (asked,) = [event for event in events(result, "instruction") if event["id"] == "t2"]
        (said,) = [event["text"] for event in events(result, "feedback") if event["id"] == "t2"]
        speed = next(state["speed"] for state in states(result.log) if state["t"] >= asked["t"] - 1e-6)
        assert said == f"We are driving {round(speed * 3.6)} km/h."


def test_plots_are_made_from_the_log(results: dict[int, RunResult], tmp_path: Path) -> None:
    for plot in (plot_velocity, plot_map):
        target = tmp_path / f"{plot.__name__}.png"
        plot(results[0].log, target)
        assert target.read_bytes().startswith(b"\x89PNG")
        assert target.stat().st_size > 20_000


def test_same_seed_same_trajectory_in_this_process_and_in_another(
    results: dict[int, RunResult], tmp_path: Path
) -> None:
    here = run_gold(load_scenario("reference"), 0, tmp_path / "here")
    code = (
        "import sys; from pathlib import Path; from wayword.runtime.scenario import load_scenario; "
        "from wayword.runtime.sweep import run_gold; "
        "run_gold(load_scenario('reference'), 0, Path(sys.argv[1]))"
    )
    subprocess.run([sys.executable, "-c", code, str(tmp_path / "there")], check=True)
    there = tmp_path / "there" / "reference" / "seed-0" / "log.jsonl"
    assert states(here.log) == states(there) == states(results[0].log)


def test_another_seed_is_another_trip(results: dict[int, RunResult]) -> None:
    assert states(results[0].log) != states(results[1].log)
