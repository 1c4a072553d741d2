"""Drives a scenario: the world, the passenger who speaks at the right moments, and the verdict."""

from collections.abc import Iterator
from pathlib import Path

from wayword.compiler import compile_program
from wayword.compiler.suggestions import suggest
from wayword.models import Translator
from wayword.models.evaluation.judgement import same_program
from wayword.runtime.copilot import CoPilot
from wayword.runtime.recording import Recorder
from wayword.runtime.result import Progress, RunResult, StepResult, Watcher
from wayword.runtime.scenario import Scenario, ScenarioError, Step, Trigger
from wayword.runtime.vehicle import VehicleState
from wayword.runtime.world import Fault, LightAhead, Map, World

STANDSTILL_MPS = 0.1


class Drive:
    """One run of a scenario with one seed.

    Args:
        scenario: What to drive.
        map_: The scenario's map.
        seed: For everything random in the world.
        log: Where the event log goes.
        translator: The model stage; None takes the gold programs.
        as_translated: Whether a program that differs from the gold one is driven nevertheless. By default it is
            reported, and the gold one is driven in its place, so that the rest of the trip can be judged as well.
        watcher: Told about progress.
    """

    def __init__(
        self,
        scenario: Scenario,
        map_: Map,
        seed: int,
        log: Path,
        translator: Translator | None = None,
        *,
        as_translated: bool = False,
        watcher: Watcher | None = None,
    ) -> None:
        check_scenario(scenario, map_, gold=translator is None)
        self._scenario = scenario
        self._translator = translator
        self._as_translated = as_translated
        self._watcher = watcher
        self._log = log
        self._seed = seed
        self._world = World(
            map_,
            seed=seed,
            vehicles=scenario.vehicles,
            faults=tuple(Fault(fault.kind, fault.junction, fault.state) for fault in scenario.faults),
            start=scenario.start,
            destination=scenario.destination,
        )
        self._result = RunResult(scenario.name, seed, log)
        self._answered_s = 0.0
        self._misread_since_s: float | None = None
        self._speeds: list[tuple[float, float]] = []  # time [s], speed [m/s]

    def run(self) -> RunResult:
        """Drives the whole scenario and judges it."""
        with Recorder(self._log) as recorder:
            recorder.record(
                "session",
                0.0,
                scenario=self._scenario.name,
                map=self._scenario.map,
                seed=self._seed,
                version=1,
            )
            self._copilot = CoPilot(self._world.vehicle, recorder)
            self._recorder = recorder
            self._observe()
            for step in self._scenario.steps:
                in_time = self._wait_for(step)
                if self._broken_off():
                    break
                self._take(step)
                if in_time:  # else it has failed already, whatever came of it
                    self._judge_step(self._result.steps[-1])
            self._drive_on(self._scenario.tail_s)
            self._judge()
            recorder.record(
                "end",
                self._world.time_s,
                success=self._result.success,
                failures=self._result.failures,
                mistranslated=[result.step.id for result in self._result.mistranslated],
                collisions=self._result.collisions,
                red_lights_run=self._result.red_lights_run,
                red_lights_overridden=self._result.red_lights_overridden,
                outcomes=dict(self._result.outcomes),
            )
        return self._result

    def _wait_for(self, step: Step) -> bool:
        """Drives until the step's moment has come; False where it didn't."""
        began = self._world.time_s
        while not self._due(step.when):
            if self._world.time_s - began > step.within_s:
                self._fail(f"{step.id}: the moment to say it did not come within {step.within_s:g} s; it was said then")
                return False
            if not self._tick(step):
                return False
        return True

    def _take(self, step: Step) -> None:
        """Takes an instruction through the stages and drives until the passenger is answered."""
        exchange = self._copilot.begin(step.id, step.say)
        result = StepResult(step, exchange)
        self._result.steps.append(result)
        self._tell(None)
        program = step.program
        if self._translator is not None:
            self._copilot.translate(exchange, self._translator)
            result.mistranslated = step.program is not None and not self._same(exchange.program, step.program)
            if result.mistranslated:
                self._recorder.record("mistranslation", self._world.time_s, id=step.id, expected=step.program)
            if not result.mistranslated or self._as_translated:
                program = exchange.program
        self._tell(None)
        self._copilot.execute(exchange, program)
        self._tell(None)
        while not exchange.done:
            if not self._tick(None):
                return
        self._answered_s = self._world.time_s
        self._tell(None)

    def _judge_step(self, result: StepResult) -> None:
        step, exchange = result.step, result.exchange
        if exchange.translation_error is not None:
            self._fail(f"{step.id}: not translated: {exchange.translation_error}")
        if step.expect is None:
            return
        if exchange.run is None:
            self._fail(f"{step.id}: nothing was executed: {exchange.feedback}")
            return
        for report in exchange.run.reports:
            if report.outcome is not step.expect:
                why = f" ({report.rationale})" if report.rationale else ""
                got = f"{report.command.action.name} {report.outcome.value}{why}"
                self._fail(f"{step.id}: expected {step.expect.value}, got {got}")

    def _same(self, program: str | None, gold: str) -> bool:
        return program is not None and same_program(program, gold, self._world.vehicle.places)

    def _due(self, trigger: Trigger) -> bool:
        if self._world.time_s - self._answered_s < trigger.after_s:
            return False
        if not self._misreads_for(trigger):
            return False
        if trigger.next_manoeuvre is None:
            return True
        state = self._world.vehicle.state()
        distance = state.next_manoeuvre_distance_m
        return (
            state.next_manoeuvre == trigger.next_manoeuvre
            and distance is not None
            and trigger.beyond_m <= distance <= trigger.within_m
        )

    def _misreads_for(self, trigger: Trigger) -> bool:
        if trigger.misread_as_red_s is None:
            return True
        since, light = self._misread_since_s, self._world.true_light_ahead()
        if since is None or light is None:
            return False
        return self._world.time_s - since >= trigger.misread_as_red_s and light.remaining_s >= trigger.green_for_s

    def _drive_on(self, duration_s: float) -> None:
        until = self._world.time_s + duration_s
        while self._world.time_s < until and self._tick(None):
            pass

    def _tick(self, waiting_for: Step | None) -> bool:
        """One step of the world; False once the run has taken too long."""
        if self._broken_off():
            return False
        self._world.step()
        self._copilot.step()
        self._observe()
        self._tell(waiting_for)
        return True

    def _broken_off(self) -> bool:
        return self._world.time_s >= self._scenario.max_s

    def _observe(self) -> None:
        """Looks at the world once after each of its steps: for the triggers, the verdict and the log."""
        state, light = self._world.vehicle.state(), self._world.true_light_ahead()
        self._note_misreading(state, light)
        self._record_state(state, light)

    def _note_misreading(self, state: VehicleState, light: LightAhead | None) -> None:
        """Notes since when the vehicle has stood before a true green that it takes for red."""
        misread = light is not None and (light.true_state, light.perceived_state) == ("green", "red")
        if not (misread and state.speed_mps < STANDSTILL_MPS):
            self._misread_since_s = None
        elif self._misread_since_s is None:
            self._misread_since_s = state.time_s

    def _record_state(self, state: VehicleState, light: LightAhead | None) -> None:
        self._speeds.append((state.time_s, state.speed_mps))
        self._recorder.record(
            "state",
            state.time_s,
            x=round(state.x_m, 3),
            y=round(state.y_m, 3),
            heading=round(state.heading_rad, 4),
            speed=round(state.speed_mps, 3),
            acceleration=round(state.acceleration_mps2, 3),
            lateral_acceleration=round(state.lateral_acceleration_mps2, 3),
            mode=state.mode.value,
            road=state.road,
            lane=state.lane,
            limit=round(state.speed_limit_mps, 3),
            light=state.traffic_light,
            true_light=light.true_state if light else None,
            binding=state.binding.constraint,
            indicator=state.indicator,
            others=[[round(value, 2) for value in other] for other in self._world.others()],
        )

    def _judge(self) -> None:
        result, monitor = self._result, self._world.monitor
        result.duration_s = self._world.time_s
        if self._broken_off():
            self._fail(f"broken off after {self._scenario.max_s:g} s")
        result.collisions = monitor.collisions
        result.red_lights_run = monitor.red_lights_run
        result.red_lights_overridden = monitor.red_lights_overridden
        if monitor.collisions:
            self._fail(f"{monitor.collisions} collision(s)")
        if monitor.red_lights_run:
            self._fail(f"{monitor.red_lights_run} red light(s) run")
        if self._scenario.standstill_at_end and self._world.vehicle.state().speed_mps > STANDSTILL_MPS:
            self._fail("the vehicle does not stand at the end")
        for failure in self._speed_failures():
            self._fail(failure)

    def _speed_failures(self) -> list[str]:
        failures = []
        for check in self._scenario.speed_checks:
            ended = [
                report.ended_s
                for result in self._result.steps
                if result.step.id == check.after and result.exchange.run is not None
                for report in result.exchange.run.reports
            ]
            if not ended:
                failures.append(f"the speed after {check.after} can't be judged: it has no outcome")
                continue
            since_s = max(ended) + check.settle_s
            fastest = 3.6 * max((speed for time, speed in self._speeds if time >= since_s), default=0.0)
            if fastest > check.at_most_kmh:
                failures.append(f"{fastest:.1f} km/h after {check.after}, where {check.at_most_kmh:g} km/h is the most")
        return failures

    def _fail(self, message: str) -> None:
        self._result.failures.append(message)

    def _tell(self, waiting_for: Step | None) -> None:
        if self._watcher is not None:
            self._watcher(Progress(self._world.vehicle.state(), self._result.steps, waiting_for))


def check_scenario(scenario: Scenario, map_: Map, *, gold: bool) -> None:
    """Makes sure that a scenario fits its map, and that there are gold programs where they are to be driven.

    Raises:
        ScenarioError: It doesn't, or there aren't; all mistakes are named.
    """
    mistakes = list(_mistakes(scenario, map_, gold=gold))
    if mistakes:
        raise ScenarioError("\n".join(f"scenario {scenario.name}: {mistake}" for mistake in mistakes))


def _mistakes(scenario: Scenario, map_: Map, *, gold: bool) -> Iterator[str]:
    junctions = [junction.id for junction in map_.junctions]
    for key, name, known in (
        ("start", scenario.start, map_.place_names),
        ("destination", scenario.destination, map_.place_names),
        *(("faults.junction", fault.junction, junctions) for fault in scenario.faults),
    ):
        if name is not None and name not in known:
            yield f"{key}: `{name}` isn't on the map {map_.name}; {suggest(name, known)}"
    for step in scenario.steps:
        if step.program is None and gold:
            yield f"steps.{step.id}: there is no gold program to drive"
        for diagnostic in compile_program(step.program, map_.place_names).diagnostics if step.program else ():
            yield f"steps.{step.id}.program, line {diagnostic.span.line}: {diagnostic.message}; {diagnostic.help}"
