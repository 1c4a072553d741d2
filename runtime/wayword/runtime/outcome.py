"""What became of a command."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from wayword.compiler import Command, format_command
from wayword.runtime.vehicle import FactValue


class Outcome(StrEnum):
    """How a command ended. Every command ends in exactly one of these."""

    SUCCEEDED = "succeeded"
    REFUSED = "refused"
    FAILED = "failed"
    TIMED_OUT = "timed_out"
    SUPERSEDED = "superseded"
    CANCELLED = "cancelled"


@dataclass(frozen=True, slots=True)
class CommandReport:
    """The execution report of one command: all that feedback may speak of.

    Attributes:
        command: The command.
        outcome: How it ended.
        rationale: Why, as a code; None where it succeeded.
        facts: Numbers and names for the passenger's ears.
        started_s: Simulated time at which it started.
        ended_s: Simulated time at which it ended.
    """

    command: Command
    outcome: Outcome
    rationale: str | None
    facts: Mapping[str, FactValue] = field(default_factory=dict)
    started_s: float = 0.0
    ended_s: float = 0.0

    def to_json(self) -> dict[str, object]:
        """The form that the event log records."""
        return {
            "action": self.command.action.name,
            "command": format_command(self.command),
            "outcome": self.outcome.value,
            "rationale": self.rationale,
            "facts": dict(self.facts),
            "started_s": round(self.started_s, 3),
            "ended_s": round(self.ended_s, 3),
        }
