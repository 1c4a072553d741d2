"""Shared by the tests of the simulated town."""

from collections.abc import Callable

from wayword.runtime.vehicle import Manoeuvre, OperationMode, Refusal
from wayword.runtime.world import World


def drive(world: World, seconds: float, until: Callable[[], bool] = lambda: False) -> bool:
    """Let time pass; whether the condition came true."""
    end = world.time_s + seconds
    while world.time_s < end - 1e-9:
        world.step()
        if until():
            return True
    return False


def arrive(world: World, seconds: float = 400.0) -> bool:
    """Drive until the car has parked at its goal."""
    vehicle = world.vehicle
    return drive(world, seconds, lambda: vehicle.mode is OperationMode.PARKED and vehicle.has_arrived())


def manoeuvre(answer: Manoeuvre | Refusal) -> Manoeuvre:
    """The manoeuvre of a request that was not refused."""
    assert isinstance(answer, Manoeuvre), answer
    return answer


def code(answer: object) -> str:
    """The rationale of a refusal."""
    assert isinstance(answer, Refusal), answer
    return answer.code
