"""Shows a drive on the terminal while it runs: each stage of each instruction, and where the car is."""

from collections.abc import Callable, Iterator

from rich.console import Console
from rich.markup import escape
from rich.status import Status

from wayword.runtime.outcome import Outcome
from wayword.runtime.result import Progress, RunResult, StepResult

_COLOURS = {Outcome.SUCCEEDED: "green", Outcome.REFUSED: "yellow"}
_LABEL_WIDTH = 13


class Trace:
    """A watcher of one run that prints what is new.

    Args:
        console: Where to print.
        status: The line at the bottom that is kept up to date.
        seed: The run's seed, named in that line.
    """

    def __init__(self, console: Console, status: Status, seed: int) -> None:
        self._console = console
        self._status = status
        self._seed = seed
        self._shown: set[tuple[str, str]] = set()

    def __call__(self, progress: Progress) -> None:
        """Takes note of progress."""
        state = progress.state
        waiting = f", waiting for the moment of {progress.waiting_for.id}" if progress.waiting_for else ""
        self._status.update(
            f"seed {self._seed}: {state.time_s:6.1f} s, {state.speed_mps * 3.6:3.0f} km/h, "
            f"{escape(state.road)}{waiting}"
        )
        if progress.steps:
            self._show(progress.steps[-1])

    def _show(self, result: StepResult) -> None:
        exchange, error = result.exchange, result.exchange.translation_error or ""
        self._once(result, "instruction", lambda: self._instruction(result))
        if exchange.translation is not None:
            self._once(result, "translation", lambda: self._translation(result))
        if exchange.translation_error is not None:
            self._once(result, "translation", lambda: self._line("translated", f"[red]not: {escape(error)}[/]"))
        if exchange.compilation is not None:
            self._once(result, "compilation", lambda: self._compilation(result))
        if exchange.done:
            self._once(result, "outcome", lambda: self._outcome(result))

    def _once(self, result: StepResult, stage: str, show: Callable[[], None]) -> None:
        if (result.step.id, stage) not in self._shown:
            self._shown.add((result.step.id, stage))
            show()

    def _instruction(self, result: StepResult) -> None:
        exchange = result.exchange
        self._console.print(
            f"\n[bold magenta]{result.step.id}[/] [dim]at {exchange.time_s:.1f} s[/]  "
            f"[bold]“{escape(exchange.instruction)}”[/]"
        )

    def _translation(self, result: StepResult) -> None:
        translation = result.exchange.translation
        assert translation is not None
        times = f"{translation.latency_ms:.0f} ms, {translation.tokens} tokens"
        if not result.mistranslated:
            self._line(
                "translated",
                f"[green]as the gold program[/] [dim]{times}[/]" if result.step.program else times,
            )
            return
        self._line("translated", f"[bold red]wrongly[/] [dim]{times}[/]")
        self._program("", translation.program)
        self._line("expected", "[dim]the gold program[/]")

    def _compilation(self, result: StepResult) -> None:
        compilation = result.exchange.compilation
        assert compilation is not None
        self._program("program", compilation.source)
        instructions = [str(i) for command in compilation.commands for i in command.instructions]
        for number, instruction in enumerate(instructions):
            self._line("" if number else "instructions", escape(instruction))
        for diagnostic in compilation.diagnostics:
            self._line("diagnostic", f"[red]{diagnostic.code.name}[/] {escape(diagnostic.message)}")
        self._line("", f"[dim]compiled in {result.exchange.compile_ms:.2f} ms[/]")

    def _outcome(self, result: StepResult) -> None:
        exchange = result.exchange
        for report in exchange.run.reports if exchange.run else ():
            colour = _COLOURS.get(report.outcome, "red")
            rationale = f" ({report.rationale})" if report.rationale else ""
            took = report.ended_s - report.started_s
            self._line(
                "outcome",
                f"[{colour}]{report.outcome.value}[/]{escape(rationale)} [dim]at {report.ended_s:.1f} s, after "
                f"{took:.1f} s[/]",
            )
        self._line("feedback", f"[cyan]“{escape(exchange.feedback or '')}”[/]")

    def _line(self, label: str, text: str) -> None:
        self._console.print(f"   [dim]{label:<{_LABEL_WIDTH}}[/]{text}", soft_wrap=True)

    def _program(self, label: str, program: str) -> None:
        for number, line in enumerate(program.rstrip("\n").split("\n")):
            self._line("" if number else label, f"[dim]│[/] {escape(line)}")


def _went_through_the_model(result: StepResult) -> bool:
    return result.exchange.translation is not None or result.exchange.translation_error is not None


def print_summary(console: Console, result: RunResult) -> None:
    """Prints the verdict on one run."""
    for label, text in _summary(result):
        console.print(f"{label:<{_LABEL_WIDTH + 3}}{text}", soft_wrap=True)


def _summary(result: RunResult) -> Iterator[tuple[str, str]]:
    yield "verdict", _verdict(result)
    for step in result.mistranslated:
        yield "mistranslated", f"{step.step.id} “{escape(step.exchange.instruction)}”"
    for failure in result.failures:
        yield "failure", f"[red]{escape(failure)}[/]"
    yield "outcomes", ", ".join(f"{count} {outcome}" for outcome, count in sorted(result.outcomes.items()))
    yield (
        "safety",
        f"{result.collisions} collisions, {result.red_lights_run} red lights run, "
        f"{result.red_lights_overridden} red lights passed because the passenger called them green",
    )
    yield "duration", f"{result.duration_s:.0f} simulated seconds"


def _verdict(result: RunResult) -> str:
    if not result.judged:
        return "[bold]driven[/], without anything to judge it by"
    if result.success:
        return "[bold green]success[/]"
    reasons = []
    judged = sum(step.step.program is not None and _went_through_the_model(step) for step in result.steps)
    if result.mistranslated:
        reasons.append(f"{len(result.mistranslated)} of {judged} instructions mistranslated")
    if result.failures:
        reasons.append(f"{len(result.failures)} failures")
    elif result.mistranslated:
        reasons.append("the vehicle itself did all that it should")
    return f"[bold red]no success[/]: {'; '.join(reasons)}"
