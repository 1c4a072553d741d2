"""Runs a scenario with many seeds, on gold programs several at a time."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path

from wayword.models import Translator
from wayword.runtime.drive import Drive
from wayword.runtime.result import RunResult, Watcher
from wayword.runtime.scenario import Scenario
from wayword.runtime.world import load_map


def log_path(folder: Path, scenario: Scenario, seed: int) -> Path:
    """Where the event log of a run is kept."""
    return folder / scenario.name / f"seed-{seed}" / "log.jsonl"


def run_gold(scenario: Scenario, seed: int, folder: Path, watcher: Watcher | None = None) -> RunResult:
    """Drives a scenario on its gold programs."""
    return Drive(scenario, load_map(scenario.map), seed, log_path(folder, scenario, seed), watcher=watcher).run()


def sweep_gold(scenario: Scenario, seeds: Sequence[int], folder: Path, processes: int) -> Iterator[RunResult]:
    """Drives a scenario on its gold programs with many seeds, as many at a time as there are processes.

    Yields:
        The results as they come in, in any order.
    """
    if processes == 1 or len(seeds) == 1:
        for seed in seeds:
            yield run_gold(scenario, seed, folder)
        return
    # Fresh processes: nothing of this one's libraries is shared with the workers.
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        futures = [pool.submit(run_gold, scenario, seed, folder) for seed in seeds]
        for future in as_completed(futures):
            yield future.result()


def sweep_translated(
    scenario: Scenario,
    seeds: Sequence[int],
    folder: Path,
    translator: Translator,
    *,
    as_translated: bool = False,
    watcher: Callable[[int], Watcher | None] = lambda _: None,
) -> Iterator[RunResult]:
    """Drives a scenario with the model in the loop, one seed after another, since the model uses every core.

    Args:
        scenario: What to drive.
        seeds: One run each.
        folder: Where logs go.
        translator: The model stage.
        as_translated: Whether wrong programs are driven, see :class:`~wayword.runtime.drive.Drive`.
        watcher: Gives the watcher for a seed.
    """
    map_ = load_map(scenario.map)
    for seed in seeds:
        log = log_path(folder, scenario, seed)
        drive = Drive(scenario, map_, seed, log, translator, as_translated=as_translated, watcher=watcher(seed))
        yield drive.run()
