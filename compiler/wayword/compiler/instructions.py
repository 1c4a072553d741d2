"""The executor's instruction set.

``REQUIRE`` is a precondition on the vehicle's state, ``DO`` has one effect, ``AWAIT`` waits for a condition with a
time-out. All quantities are SI. The assembly text of an instruction is its ``str``.
"""

from dataclasses import dataclass
from typing import ClassVar


@dataclass(frozen=True, slots=True)
class Scalar:
    """A physical quantity: its value with the SI unit it is in."""

    value: float
    unit: str

    def __str__(self) -> str:
        return f"{self.value:.10g} {self.unit}"

    def to_json(self) -> dict[str, float | str]:
        """The form that ``--json`` prints."""
        return {"value": self.value, "unit": self.unit}


@dataclass(frozen=True, slots=True)
class Symbol:
    """A word of the language, or the name of a place, which is printed in quotes."""

    text: str
    is_place: bool = False

    def __str__(self) -> str:
        return f'"{self.text}"' if self.is_place else self.text

    def to_json(self) -> str:
        """The form that ``--json`` prints."""
        return self.text


Operand = Scalar | Symbol
Operands = tuple[tuple[str, Operand], ...]


@dataclass(frozen=True, slots=True)
class Instruction:
    """What the three kinds of instruction share.

    Attributes:
        name: The predicate, effect or condition.
        operands: Named operands, in order.
    """

    opcode: ClassVar[str]

    name: str
    operands: Operands = ()

    def operand(self, name: str) -> Operand | None:
        """An operand by name, None where it was left out."""
        return dict(self.operands).get(name)

    def word(self, name: str) -> str:
        """An operand that is a word or a place.

        Raises:
            KeyError: The instruction has no such operand.
        """
        operand = dict(self.operands)[name]
        return operand.text if isinstance(operand, Symbol) else str(operand)

    def _parts(self) -> list[str]:
        return [f"{name}={operand}" for name, operand in self.operands]

    def __str__(self) -> str:
        return f"{self.opcode:<7} {self.name} {', '.join(self._parts())}".rstrip()

    def to_json(self) -> dict[str, object]:
        """The form that ``--json`` prints."""
        operands = {name: operand.to_json() for name, operand in self.operands}
        return {"opcode": self.opcode, "name": self.name, "operands": operands, "text": str(self)}


@dataclass(frozen=True, slots=True)
class Require(Instruction):
    """A precondition; the command is refused where it doesn't hold."""

    opcode: ClassVar[str] = "REQUIRE"


@dataclass(frozen=True, slots=True)
class Do(Instruction):
    """One effect on the vehicle, or an answer to the passenger."""

    opcode: ClassVar[str] = "DO"


@dataclass(frozen=True, slots=True)
class Await(Instruction):
    """Waits until a condition holds.

    Attributes:
        timeout_s: How long to wait before the command has timed out, in simulated seconds.
    """

    opcode: ClassVar[str] = "AWAIT"

    timeout_s: float = 0.0

    def _parts(self) -> list[str]:
        return [*Instruction._parts(self), f"timeout={self.timeout_s:g} s"]

    def to_json(self) -> dict[str, object]:
        """The form that ``--json`` prints."""
        return {**Instruction.to_json(self), "timeout_s": self.timeout_s}
