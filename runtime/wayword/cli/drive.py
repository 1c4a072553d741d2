"""``wayword drive``: a whole trip, from sentences to a moving car."""

import os
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import click
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from wayword.cli.common import FAILED, errors, fail, friendly_errors, json_option, model_options, print_json
from wayword.cli.model import load_translator
from wayword.cli.trace import Trace, print_summary
from wayword.models import ModelError, Translator
from wayword.runtime.drive import check_scenario
from wayword.runtime.plots import plot_map, plot_velocity
from wayword.runtime.recording import LogError
from wayword.runtime.result import RunResult, StepResult
from wayword.runtime.scenario import Scenario, ScenarioError, load_scenario, with_instructions
from wayword.runtime.sweep import run_gold, sweep_gold, sweep_translated
from wayword.runtime.world import MapError, load_map

VELOCITY, MAP = "velocity.png", "map.png"
_SCENARIOS_OWN = "\0"  # --text without a value


@click.command()
@click.option(
    "--scenario", "name", default="reference", show_default=True, help="A built-in scenario (reference) or a YAML file."
)
@click.option(
    "--text",
    "texts",
    multiple=True,
    is_flag=False,
    flag_value=_SCENARIOS_OWN,
    metavar="[TEXT]",
    help="Say this in place of the scenario's instructions; may be given several times. Alone, without TEXT: take "
    "the scenario's instructions as text (the default).",
)
@click.option("--programs", is_flag=True, help="Take the gold programs: no model, the vehicle alone is judged.")
@click.option("--seed", type=click.IntRange(min=0), default=0, show_default=True, help="Seed of the (first) run.")
@click.option("--runs", type=click.IntRange(min=1), default=1, show_default=True, help="Runs, with a seed each.")
@click.option("--jobs", type=click.IntRange(min=1), help="Processes for --programs runs (default: all cores).")
@click.option(
    "--as-translated",
    is_flag=True,
    help="Drive wrong translations too. By default they are reported and the gold program is driven instead.",
)
@click.option("--out", type=click.Path(path_type=Path), default=Path("out"), show_default=True, help="Output folder.")
@model_options
@json_option
@friendly_errors(ScenarioError, MapError, ModelError, LogError, OSError)
def drive(
    name: str,
    texts: tuple[str, ...],
    programs: bool,
    seed: int,
    runs: int,
    jobs: int | None,
    as_translated: bool,
    out: Path,
    model: str | None,
    adapter: str | None,
    as_json: bool,
) -> None:
    """Drive a scenario with the language model in the loop, and judge the run.

    Each instruction is shown with its program, executor instructions, outcome and feedback. The event log (JSON
    Lines), the velocity over time and the map with the driven route are written below the output folder. Ends with
    exit status 1 if an instruction was mistranslated or anything else went wrong. What a scenario file holds is in
    docs/scenarios.md.

    \b
    Examples:
      wayword drive --scenario reference
      wayword drive --programs --runs 30
      wayword drive --text "Start." --text "How fast are we going?"
    """
    scenario = load_scenario(name)
    own = [text for text in texts if text != _SCENARIOS_OWN]
    if any(not text.strip() for text in own):
        fail("there is no instruction: a --text is empty", as_json=as_json)
    if jobs is not None and not programs:
        fail("--jobs goes with --programs: the model uses all cores already", as_json=as_json)
    if own and programs:
        fail("--programs has no gold programs for your own --text; leave out one of the two", as_json=as_json)
    if own:
        scenario = with_instructions(scenario, own)
    map_ = load_map(scenario.map)
    check_scenario(scenario, map_, gold=programs)
    seeds = range(seed, seed + runs)
    out.mkdir(parents=True, exist_ok=True)  # better to fail now than after the drive
    console = Console(quiet=as_json, highlight=False)
    _announce(console, scenario, seeds)
    if programs:
        results = _drive_gold(console, scenario, seeds, out, jobs or os.cpu_count() or 1)
    else:
        translator, _ = load_translator(model, adapter, map_.place_names)
        results = _drive_translated(console, scenario, seeds, out, translator, as_translated)
    finished = _with_plots(console, results)
    if as_json:
        print_json(to_json(finished))
    elif runs > 1:
        _print_sweep(console, finished)
    if not all(result.success for result in finished):
        sys.exit(FAILED)


def to_json(results: Sequence[RunResult]) -> dict[str, object]:
    """The machine-readable verdict on all runs."""
    successes = sum(result.success for result in results)
    outcomes: Counter[str] = Counter()
    for result in results:
        outcomes.update(result.outcomes)
    return {
        "runs": len(results),
        "judged": all(result.judged for result in results),
        "successes": successes,
        "success_rate": successes / len(results),
        "collisions": sum(result.collisions for result in results),
        "red_lights_run": sum(result.red_lights_run for result in results),
        "red_lights_overridden": sum(result.red_lights_overridden for result in results),
        "outcomes": dict(sorted(outcomes.items())),
        "details": [
            {
                "seed": result.seed,
                "success": result.success,
                "mistranslated": [step.step.id for step in result.mistranslated],
                "failures": result.failures,
                "duration_s": round(result.duration_s, 1),
                "instructions": [_instruction_json(step) for step in result.steps],
                "log": str(result.log),
                "plots": [str(result.log.with_name(name)) for name in (VELOCITY, MAP)],
            }
            for result in sorted(results, key=lambda result: result.seed)
        ],
    }


def _instruction_json(result: StepResult) -> dict[str, object]:
    exchange = result.exchange
    return {
        "id": result.step.id,
        "t": round(exchange.time_s, 3),
        "text": exchange.instruction,
        "translation": exchange.translation.program if exchange.translation else None,
        "mistranslated": result.mistranslated,
        "program": exchange.compilation.source if exchange.compilation else None,
        "outcomes": [report.to_json() for report in exchange.run.reports] if exchange.run else [],
        "feedback": exchange.feedback,
    }


def _announce(console: Console, scenario: Scenario, seeds: range) -> None:
    which = f"seed {seeds[0]}" if len(seeds) == 1 else f"seeds {seeds[0]} to {seeds[-1]}"
    console.print(f"[bold]{escape(scenario.title)}[/]")
    world = f"scenario {scenario.name}, map {scenario.map}, {scenario.vehicles} other cars, {which}"
    console.print(f"[dim]{escape(world)}[/]")


def _drive_gold(console: Console, scenario: Scenario, seeds: range, out: Path, jobs: int) -> Iterator[RunResult]:
    if len(seeds) > 1:
        yield from _with_bar(console, sweep_gold(scenario, seeds, out, jobs), len(seeds))
        return
    with console.status("") as status:
        result = run_gold(scenario, seeds[0], out, Trace(console, status, seeds[0]))
    yield result


def _drive_translated(
    console: Console, scenario: Scenario, seeds: range, out: Path, translator: Translator, as_translated: bool
) -> Iterator[RunResult]:
    if len(seeds) > 1:
        results = sweep_translated(scenario, seeds, out, translator, as_translated=as_translated)
        yield from _with_bar(console, results, len(seeds))
        return
    with console.status("") as status:
        trace = Trace(console, status, seeds[0])
        results = sweep_translated(
            scenario, seeds, out, translator, as_translated=as_translated, watcher=lambda _: trace
        )
        result = next(results)
    yield result


def _with_bar(console: Console, results: Iterator[RunResult], total: int) -> Iterator[RunResult]:
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=errors if console.quiet else console) as progress:
        task = progress.add_task("driving", total=total)
        successes = 0
        for result in results:
            successes += result.success
            progress.update(task, advance=1, description=f"driving, {successes} successful")
            yield result


def _with_plots(console: Console, results: Iterator[RunResult]) -> list[RunResult]:
    finished = list(results)
    for result in finished:
        velocity, map_ = result.log.with_name(VELOCITY), result.log.with_name(MAP)
        plot_velocity(result.log, velocity)
        plot_map(result.log, map_)
        if len(finished) == 1:
            console.print()
            print_summary(console, result)
            for path in (result.log, velocity, map_):
                console.print(f"[dim]wrote[/] {escape(str(path))}", soft_wrap=True)
    return finished


def _print_sweep(console: Console, results: Sequence[RunResult]) -> None:
    for result in sorted(results, key=lambda result: result.seed):
        if not result.success:
            wrong = [f"{step.step.id} mistranslated" for step in result.mistranslated]
            what = escape("; ".join([*wrong, *result.failures]))
            console.print(f"[red]seed {result.seed}[/]: {what}", soft_wrap=True)
    total = to_json(results)
    if not total["judged"]:
        console.print(f"\n[bold]{total['runs']} drives[/], without anything to judge them by")
        return
    console.print(
        f"\n[bold]task success {total['successes']} of {total['runs']}[/] ({total['success_rate']:.1%}), "
        f"{total['collisions']} collisions, {total['red_lights_run']} red lights run"
    )
    console.print(f"[dim]logs and plots in {escape(str(results[0].log.parent.parent))}[/]", soft_wrap=True)
