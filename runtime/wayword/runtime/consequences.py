"""What comes of a program in the vehicle: it is carried out in mid-trip, and the true world is watched."""

from dataclasses import dataclass

from wayword.compiler import compile_program
from wayword.runtime.executor import Executor, ProgramRun
from wayword.runtime.world import Map, World

_START = "command_type: MISSION\naction: START\n"
_LEAD_IN_S, _WATCHED_S = 20.0, 60.0
_SPEED_TOLERANCE_MPS = 0.5


@dataclass(frozen=True, slots=True)
class Consequences:
    """What happened after a program was given.

    Attributes:
        outcomes: The outcome of each command, "not compiled" where the compiler refused the program; "running" where
            a command was still at it when the watch ended.
        collisions: Collisions of our vehicle.
        red_lights_run: Red lights that it passed, on the passenger's word or without.
        excess_mps: By how much it was faster than the legal limit at most.
    """

    outcomes: tuple[str, ...]
    collisions: int
    red_lights_run: int
    excess_mps: float

    @property
    def safe(self) -> bool:
        """Whether no rule that holds for every command was broken."""
        return not self.collisions and not self.red_lights_run and self.excess_mps <= _SPEED_TOLERANCE_MPS


def consequences(program: str, map_: Map, seed: int = 0) -> Consequences:
    """Gives a program to a vehicle that is under way in traffic, and watches for a minute.

    Args:
        program: What to carry out.
        map_: Where.
        seed: For everything random in the world.
    """
    world = World(map_, seed=seed, destination=map_.place_names[0])
    executor = Executor(world.vehicle)
    executor.submit(compile_program(_START, map_.place_names).commands)
    _drive(world, executor, _LEAD_IN_S)
    compiled = compile_program(program, map_.place_names)
    run = executor.submit(compiled.commands) if compiled.ok else None
    excess = _drive(world, executor, _WATCHED_S)
    return Consequences(
        outcomes=_outcomes(run) if run is not None else ("not compiled",),
        collisions=world.monitor.collisions,
        red_lights_run=world.monitor.red_lights_run + world.monitor.red_lights_overridden,
        excess_mps=excess,
    )


def _drive(world: World, executor: Executor, duration_s: float) -> float:
    """Lets time pass; returns the largest excess over the legal limit, in m/s, at least 0."""
    until, excess = world.time_s + duration_s, 0.0
    while world.time_s < until:
        world.step()
        executor.step()
        state = world.vehicle.state()
        excess = max(excess, state.speed_mps - state.speed_limit_mps)
    return excess


def _outcomes(run: ProgramRun) -> tuple[str, ...]:
    ended = tuple(report.outcome.value for report in run.reports)
    return ended if run.done else (*ended, "running")
