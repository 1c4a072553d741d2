"""The co-pilot session: takes an instruction through every stage, from words to feedback."""

from dataclasses import dataclass
from time import perf_counter

from wayword.compiler import Compilation, compile_program
from wayword.models import Translation, Translator
from wayword.models.confidence import asks_back, program_to_run
from wayword.runtime.executor import Executor, ProgramRun
from wayword.runtime.feedback import feedback, not_compiled, not_understood
from wayword.runtime.recording import Recorder
from wayword.runtime.vehicle import VehicleInterface


@dataclass(slots=True)
class Exchange:
    """One instruction on its way.

    Attributes:
        id: Its name in the log.
        instruction: What the passenger said.
        time_s: Simulated time at which it was said.
        translation: What the model made of it; None for a program given directly.
        translation_error: Why the model made nothing of it.
        program: The program to run: the translation, or where the model is too unsure of it, a question.
        compilation: What the compiler made of the program; None where there is no program.
        run: Its execution; None where it didn't compile.
        compile_ms: Wall-clock time of compiling.
        dispatch_ms: Wall-clock time of validating and starting.
        feedback: What the passenger was told; None while it isn't known.
    """

    id: str
    instruction: str
    time_s: float
    translation: Translation | None = None
    translation_error: str | None = None
    program: str | None = None
    compilation: Compilation | None = None
    run: ProgramRun | None = None
    compile_ms: float = 0.0
    dispatch_ms: float = 0.0
    feedback: str | None = None

    @property
    def done(self) -> bool:
        """Whether the passenger has been answered."""
        return self.feedback is not None


class CoPilot:
    """Mediates between a passenger and a vehicle.

    Args:
        vehicle: The vehicle.
        recorder: Where every stage is logged.
    """

    def __init__(self, vehicle: VehicleInterface, recorder: Recorder) -> None:
        self.vehicle = vehicle
        self.executor = Executor(vehicle)
        self._recorder = recorder
        self._open: list[Exchange] = []

    def translate(self, exchange: Exchange, translator: Translator) -> None:
        """First model stage: words to a program, under the vehicle's present status.

        A failing model leaves the exchange without a program; the vehicle drives on as before.
        """
        status = self.vehicle.status()
        self._record("status", exchange, **status.model_dump(mode="json"))
        try:
            exchange.translation = translator.translate(exchange.instruction, status)
        except (ValueError, RuntimeError, OSError) as error:
            exchange.translation_error = str(error)
            self._record("translation_failed", exchange, error=str(error))
            return
        exchange.program = program_to_run(exchange.translation)
        self._record(
            "translation",
            exchange,
            program=exchange.translation.program,
            asks_back=asks_back(exchange.translation),
            latency_ms=round(exchange.translation.latency_ms, 1),
            tokens=exchange.translation.tokens,
            confidence=round(exchange.translation.confidence, 4),
        )

    def execute(self, exchange: Exchange, program: str | None) -> None:
        """Compiles a program and starts it. None, where there is no program, is answered with a plain sentence."""
        if program is None:
            self._answer(exchange, not_understood())
            return
        started = perf_counter()
        exchange.compilation = compile_program(program, self.vehicle.places)
        exchange.compile_ms = (perf_counter() - started) * 1000
        self._record(
            "compilation",
            exchange,
            program=program,
            ok=exchange.compilation.ok,
            diagnostics=[diagnostic.to_json() for diagnostic in exchange.compilation.diagnostics],
            instructions=[str(i) for command in exchange.compilation.commands for i in command.instructions],
        )
        if not exchange.compilation.ok:
            self._answer(exchange, not_compiled(exchange.compilation.diagnostics))
            return
        started = perf_counter()
        exchange.run = self.executor.submit(exchange.compilation.commands)
        exchange.dispatch_ms = (perf_counter() - started) * 1000
        self._open.append(exchange)
        self._close_finished()

    def begin(self, identifier: str, instruction: str) -> Exchange:
        """Opens an exchange at this moment."""
        exchange = Exchange(identifier, instruction, self.vehicle.state().time_s)
        self._record("instruction", exchange, text=instruction)
        return exchange

    def step(self) -> None:
        """Looks after the running programs; to be called once per step of the world."""
        self.executor.step()
        self._close_finished()

    def _close_finished(self) -> None:
        for exchange in self._open:
            if exchange.run is not None and exchange.run.done:
                for report in exchange.run.reports:
                    self._record("outcome", exchange, **report.to_json())
                self._answer(exchange, feedback(exchange.run.reports))
        self._open = [exchange for exchange in self._open if not exchange.done]

    def _answer(self, exchange: Exchange, text: str) -> None:
        exchange.feedback = text
        self._record("feedback", exchange, text=text)

    def _record(self, event: str, exchange: Exchange, **fields: object) -> None:
        self._recorder.record(event, self.vehicle.state().time_s, id=exchange.id, **fields)
