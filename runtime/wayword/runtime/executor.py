"""Runs lowered programs against a vehicle, beside each other, one step of the world at a time."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from wayword.compiler import Await, Command, Do, LoweredCommand
from wayword.runtime.effects import CONDITIONS, EFFECTS
from wayword.runtime.outcome import CommandReport, Outcome
from wayword.runtime.validator import validate
from wayword.runtime.vehicle import FactValue, Manoeuvre, ManoeuvreState, Refusal, VehicleInterface

SUPERSEDED_BY: dict[str, frozenset[str]] = {
    "START": frozenset({"START", "STOP"}),
    "STOP": frozenset({"START", "STOP", "TURN", "CHANGE_LANE"}),
    "TURN": frozenset({"TURN"}),
    "CHANGE_LANE": frozenset({"CHANGE_LANE"}),
}
"""Which waiting commands a newer command puts an end to. EMERGENCY_STOP puts an end to all."""

GOES_ON_AFTER = frozenset({"reject_unrelated", "reject_unsupported"})
"""Refusals after which the rest of a program still runs (language.md section 1)."""


@dataclass(slots=True)
class ProgramRun:
    """A program under execution.

    Attributes:
        commands: The program.
        reports: What became of the commands that have ended, in order.
    """

    commands: tuple[LoweredCommand, ...]
    reports: list[CommandReport] = field(default_factory=list)

    # The command that waits at an AWAIT, if one does.
    _awaiting: Await | None = None
    _manoeuvre: Manoeuvre | None = None
    _facts: dict[str, FactValue] = field(default_factory=dict)
    _started_s: float = 0.0
    _awaiting_since_s: float = 0.0

    @property
    def done(self) -> bool:
        """Whether every command has its outcome."""
        return len(self.reports) == len(self.commands)

    @property
    def current(self) -> Command:
        """The command whose outcome comes next."""
        return self.commands[len(self.reports)].command


class Executor:
    """Executes programs against one vehicle.

    Several programs may be under way at a time, for example a turn that waits for its junction while a question is
    answered. A newer command supersedes the waiting ones that contradict it, once the vehicle has accepted it.

    Args:
        vehicle: The vehicle.
    """

    def __init__(self, vehicle: VehicleInterface) -> None:
        self.vehicle = vehicle
        self._runs: list[ProgramRun] = []

    def submit(self, commands: Sequence[LoweredCommand]) -> ProgramRun:
        """Starts a program at once. Its run is complete when ``done``; until then call :meth:`step`."""
        run = ProgramRun(tuple(commands))
        self._runs.append(run)
        self._advance(run)
        self._runs = [run for run in self._runs if not run.done]
        return run

    def step(self) -> None:
        """Looks at every waiting command again; to be called once per step of the world."""
        for run in self._runs:
            if not run.done:
                self._watch(run)
                if run._awaiting is None:
                    self._advance(run)
        self._runs = [run for run in self._runs if not run.done]

    def _advance(self, run: ProgramRun) -> None:
        """Starts commands until one has to wait or the program has ended."""
        while not run.done and run._awaiting is None:
            if run.reports and not _goes_on(run.reports[-1]):
                self._end(run, Outcome.CANCELLED, Refusal("earlier_command_failed"), fresh=True)
            else:
                self._start(run, run.commands[len(run.reports)])

    def _start(self, run: ProgramRun, lowered: LoweredCommand) -> None:
        run._started_s, run._manoeuvre = self._now(), None
        run._facts = {argument.name: str(argument.value) for argument in lowered.command.arguments}
        refusal = validate(self.vehicle, lowered)
        if refusal is not None:
            self._end(run, Outcome.REFUSED, refusal)
            return
        for instruction in lowered.instructions:
            if isinstance(instruction, Do):
                effect = EFFECTS[instruction.name](self.vehicle, instruction)
                if isinstance(effect, Refusal):
                    self._end(run, Outcome.REFUSED, effect)
                    return
                run._facts.update(effect.facts)
                run._manoeuvre = effect.manoeuvre
            elif isinstance(instruction, Await):
                run._awaiting, run._awaiting_since_s = instruction, self._now()
        self._supersede(run)
        if run._awaiting is None:
            self._end(run, Outcome.SUCCEEDED)
        else:
            self._watch(run)

    def _supersede(self, newer: ProgramRun) -> None:
        action = newer.current.action.name
        for run in self._runs:
            if run is newer or run._awaiting is None:
                continue
            if action == "EMERGENCY_STOP" or run.current.action.name in SUPERSEDED_BY.get(action, ()):
                if self._goes_on_regardless(run) and action != "EMERGENCY_STOP":
                    continue
                self._end(run, Outcome.SUPERSEDED, Refusal("superseded", {"by": action}))
                self._advance(run)

    def _goes_on_regardless(self, run: ProgramRun) -> bool:
        """Calls a manoeuvre off; whether it is too late for that, as when the car is moving over already."""
        if run._manoeuvre is not None and run._manoeuvre.state is ManoeuvreState.RUNNING:
            self.vehicle.cancel(run._manoeuvre)
            return run._manoeuvre.state is ManoeuvreState.RUNNING
        return False

    def _watch(self, run: ProgramRun) -> None:
        awaited = run._awaiting
        assert awaited is not None
        manoeuvre = run._manoeuvre
        if CONDITIONS[awaited.name](self.vehicle, manoeuvre):
            self._end(run, Outcome.SUCCEEDED)
        elif manoeuvre is not None and manoeuvre.state is ManoeuvreState.FAILED:
            self._end(run, Outcome.FAILED, manoeuvre.refusal)
        elif self._now() - run._awaiting_since_s > awaited.timeout_s:
            if manoeuvre is not None:
                self.vehicle.cancel(manoeuvre)
            self._end(run, Outcome.TIMED_OUT, Refusal("timeout", {"timeout_s": awaited.timeout_s}))

    def _end(self, run: ProgramRun, outcome: Outcome, refusal: Refusal | None = None, *, fresh: bool = False) -> None:
        """Gives the current command its outcome. A `fresh` command has not been started."""
        now = self._now()
        manoeuvre_facts = run._manoeuvre.facts if run._manoeuvre else {}
        facts = {} if fresh else {**run._facts, **manoeuvre_facts}
        run.reports.append(
            CommandReport(
                command=run.current,
                outcome=outcome,
                rationale=refusal.code if refusal else None,
                facts={**facts, **(refusal.facts if refusal else {})},
                started_s=now if fresh else run._started_s,
                ended_s=now,
            )
        )
        run._awaiting = run._manoeuvre = None

    def _now(self) -> float:
        return self.vehicle.state().time_s


def _goes_on(report: CommandReport) -> bool:
    return report.outcome is Outcome.SUCCEEDED or report.rationale in GOES_ON_AFTER
