"""What became of a run of a scenario, and what its watchers are told."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from wayword.runtime.copilot import Exchange
from wayword.runtime.outcome import Outcome
from wayword.runtime.scenario import Step
from wayword.runtime.vehicle import VehicleState


@dataclass(slots=True)
class StepResult:
    """What became of one instruction of a scenario.

    Attributes:
        step: The scenario's step.
        exchange: Its way through the stages.
        mistranslated: Whether the model's program differs from the gold one.
    """

    step: Step
    exchange: Exchange
    mistranslated: bool = False

    @property
    def outcomes(self) -> list[Outcome]:
        """The outcomes of its commands so far."""
        return [report.outcome for report in self.exchange.run.reports] if self.exchange.run else []


@dataclass(slots=True)
class RunResult:
    """One run of a scenario.

    Attributes:
        scenario: Its name.
        seed: Its seed.
        log: The event log.
        steps: What became of each instruction.
        failures: Everything that went wrong other than a translation.
        duration_s: Simulated duration.
        collisions: Collisions of our vehicle.
        red_lights_run: Red lights that it passed without the passenger's override.
        red_lights_overridden: Red lights that it passed on the passenger's word.
    """

    scenario: str
    seed: int
    log: Path
    steps: list[StepResult] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)
    duration_s: float = 0.0
    collisions: int = 0
    red_lights_run: int = 0
    red_lights_overridden: int = 0

    @property
    def mistranslated(self) -> list[StepResult]:
        """The instructions that the model got wrong."""
        return [step for step in self.steps if step.mistranslated]

    @property
    def success(self) -> bool:
        """Whether every instruction was translated and carried out as it should be, safely."""
        return not self.failures and not self.mistranslated

    @property
    def judged(self) -> bool:
        """Whether there was anything to judge the run by, other than safety."""
        return any(step.step.program is not None or step.step.expect is not None for step in self.steps)

    @property
    def outcomes(self) -> Counter[str]:
        """How many commands had which outcome."""
        return Counter(outcome.value for step in self.steps for outcome in step.outcomes)


@dataclass(frozen=True, slots=True)
class Progress:
    """What a watcher of a run is told, after every step of the world and every stage of an instruction.

    Attributes:
        state: The vehicle's state.
        steps: The instructions so far.
        waiting_for: The step whose moment has not come yet, if any.
    """

    state: VehicleState
    steps: list[StepResult]
    waiting_for: Step | None


Watcher = Callable[[Progress], None]
