"""Scenarios as files: a world, faults in it, and what the passenger says when."""

from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from typing import Literal, Self

import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator

from wayword.compiler import compile_program, render_all
from wayword.models.validation import explain, is_text
from wayword.runtime.outcome import Outcome


class ScenarioError(Exception):
    """A scenario that can't be used. The message names the file and the entry."""


_NAME = r"^[A-Za-z0-9_-]{1,64}$"  # it names files and folders


class _Model(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class FaultSpec(_Model):
    """Something that the vehicle's perception gets wrong.

    Attributes:
        kind: ``misread_light``: at `junction`, every light is seen as `state`.
        junction: Identifier of a junction on the map.
        state: What is seen.
    """

    kind: Literal["misread_light"]
    junction: str
    state: Literal["red", "green"]


class Trigger(_Model):
    """When the passenger speaks: as soon as everything named here holds.

    Attributes:
        after_s: So many simulated seconds after the passenger's last instruction was answered (or the start).
        misread_as_red_s: The vehicle has waited for so long before a light that it takes for red and that truly is
            green ...
        green_for_s: ... and that will truly stay green for at least so long.
        next_manoeuvre: The route's next manoeuvre is this one ...
        within_m: ... and it is due within this distance ...
        beyond_m: ... but not nearer than this.
    """

    after_s: float = Field(default=0.0, ge=0)
    misread_as_red_s: float | None = Field(default=None, gt=0)
    green_for_s: float = Field(default=0.0, ge=0)
    next_manoeuvre: Literal["left", "right", "straight", "arrive"] | None = None
    within_m: float = Field(default=1000.0, gt=0)
    beyond_m: float = Field(default=0.0, ge=0)


class Step(_Model):
    """One instruction of the passenger.

    Attributes:
        id: Name of the moment, marked in plots.
        say: What the passenger says.
        program: What it means, as a program (the gold translation); None where nobody has said so, as in a drive with
            instructions of one's own.
        when: When it is said.
        within_s: If that moment doesn't come within so many simulated seconds, it is said all the same, and the run
            has failed.
        expect: The outcome that every command of the program must have; None where any will do.
    """

    id: str = Field(pattern=_NAME)
    say: str
    program: str | None = None
    when: Trigger = Trigger()
    within_s: float = Field(default=240.0, gt=0)
    expect: Outcome | None = Outcome.SUCCEEDED

    @field_validator("say")
    @classmethod
    def _is_text(cls, say: str) -> str:
        if not say.strip() or not is_text(say):
            raise ValueError("is no text that can be said")
        return say

    @field_validator("program")
    @classmethod
    def _compiles(cls, program: str | None) -> str | None:
        if program is None:
            return None
        result = compile_program(program)
        if not result.ok:
            raise ValueError("the gold program does not compile:\n" + render_all(result.diagnostics, program))
        return program


class SpeedCheck(_Model):
    """The vehicle's speed stays at or below a bound.

    Attributes:
        at_most_kmh: The bound.
        after: From the outcome of this step on ...
        settle_s: ... plus the time that comfortable braking takes.
    """

    at_most_kmh: float = Field(gt=0)
    after: str
    settle_s: float = Field(ge=0)


class Scenario(_Model):
    """A scenario.

    Attributes:
        name: Its name.
        title: What happens in it, in one line.
        map: Name of the map.
        start: Place where the vehicle is parked.
        destination: Goal that is set beforehand, if any.
        vehicles: Number of other road users.
        faults: What perception gets wrong.
        steps: What the passenger says, in order.
        speed_checks: Bounds on the speed.
        standstill_at_end: Whether the vehicle must stand at the end.
        tail_s: Simulated seconds to go on after the last answer.
        max_s: Simulated seconds after which the run is broken off.
    """

    name: str = Field(pattern=_NAME)
    title: str
    map: str = "town"
    start: str
    destination: str | None = None
    vehicles: int = Field(default=20, ge=0, le=200)
    faults: tuple[FaultSpec, ...] = ()
    steps: tuple[Step, ...]
    speed_checks: tuple[SpeedCheck, ...] = ()
    standstill_at_end: bool = False
    tail_s: float = Field(default=3.0, ge=0)
    max_s: float = Field(default=900.0, gt=0)

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        ids = [step.id for step in self.steps]
        repeated = {name for name in ids if ids.count(name) > 1}
        if repeated:
            raise ValueError(f"several steps have the id {', '.join(sorted(repeated))}")
        for check in self.speed_checks:
            if check.after not in ids:
                raise ValueError(f"a speed check refers to the step {check.after}, which isn't there")
        return self


def with_instructions(scenario: Scenario, instructions: Sequence[str], pause_s: float = 8.0) -> Scenario:
    """The same world and faults with a passenger who says something else, one sentence after another.

    Args:
        scenario: The scenario.
        instructions: What the passenger says.
        pause_s: Simulated seconds between an answer and the next sentence.
    """
    steps = tuple(
        Step(id=f"t{index}", say=text, when=Trigger(after_s=pause_s), expect=None)
        for index, text in enumerate(instructions)
    )
    return scenario.model_copy(
        update={
            "name": f"{scenario.name}-own-text",
            "title": "Your own instructions in the world of this scenario",
            "steps": steps,
            "speed_checks": (),
            "standstill_at_end": False,
            "tail_s": 2 * pause_s,
        }
    )


def scenario_names() -> list[str]:
    """Names of the scenarios that come with Wayword."""
    folder = files("wayword.runtime").joinpath("scenarios")
    return sorted(entry.name.removesuffix(".yaml") for entry in folder.iterdir() if entry.name.endswith(".yaml"))


def load_scenario(name: str) -> Scenario:
    """Loads a scenario by its name, or from a file where `name` is the path of one.

    Raises:
        ScenarioError: There is no such scenario, or it is malformed.
    """
    if name in scenario_names():
        text = files("wayword.runtime").joinpath(f"scenarios/{name}.yaml").read_text(encoding="utf-8")
    else:
        path = Path(name)
        if not path.is_file():
            known = ", ".join(scenario_names())
            raise ScenarioError(f"no scenario `{name}`; give the path of a file or one of: {known}")
        try:
            text = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise ScenarioError(f"{name}: {error}") from error
    try:
        return Scenario.model_validate(yaml.safe_load(text))
    except (yaml.YAMLError, RecursionError) as error:
        raise ScenarioError(f"{name}: {error}") from error
    except ValidationError as error:
        raise ScenarioError(f"{name}: {explain(error, Scenario)}") from error
