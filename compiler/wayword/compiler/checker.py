"""Written commands to a well-typed program: names, parameter lists and places. Values are in ``values.py``."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from wayword.compiler.diagnostics import (
    MISSING_PARAMETER,
    NOT_ADJUSTABLE,
    NOT_ONE_SETTING,
    REPEATED_PARAMETER,
    TOO_MANY_COMMANDS,
    UNKNOWN_ACTION,
    UNKNOWN_COMMAND_TYPE,
    UNKNOWN_PARAMETER,
    WRONG_COMMAND_TYPE,
    Code,
    Diagnostic,
)
from wayword.compiler.spans import Span
from wayword.compiler.suggestions import suggest
from wayword.compiler.syntax import (
    Argument,
    Command,
    Program,
    Value,
    Written,
    WrittenCommand,
    WrittenParameter,
)
from wayword.compiler.values import Problem, read_delta, read_setting, read_value
from wayword.compiler.vocabulary import (
    ACTIONS,
    DRIVING_PARAMETERS,
    Action,
    Arguments,
    Choice,
    CommandType,
    DrivingParameter,
)

MAX_COMMANDS = 4


def check(
    commands: Sequence[WrittenCommand], places: Sequence[str] | None
) -> tuple[Program | None, tuple[Diagnostic, ...]]:
    """Checks every command and collects all mistakes.

    Args:
        commands: The commands as written.
        places: Names on the loaded map; None accepts any well-formed name.

    Returns:
        The well-typed program, or None where there is an error; and the diagnostics.
    """
    checker = _Checker(places)
    checked = [checker.command(command) for command in commands[:MAX_COMMANDS]]
    if len(commands) > MAX_COMMANDS:
        checker.report(
            TOO_MANY_COMMANDS,
            commands[MAX_COMMANDS].command_type.span,
            f"a program has at most {MAX_COMMANDS} commands, this one has {len(commands)}",
        )
    if checker.diagnostics:
        return None, tuple(checker.diagnostics)
    return Program(tuple(command for command in checked if command is not None)), ()


@dataclass
class _Checker:
    """Collects what is wrong; every method returns None where it reported something."""

    places: Sequence[str] | None
    diagnostics: list[Diagnostic] = field(default_factory=list)

    def report(self, code: Code, span: Span, message: str, help_text: str | None = None) -> None:
        self.diagnostics.append(Diagnostic(code, span, message, help_text))

    def command(self, written: WrittenCommand) -> Command | None:
        action = self._action(written)
        if action is None:
            return None
        if action.arguments is Arguments.OWN:
            arguments = self._own_arguments(action, written)
        else:
            arguments = self._one_setting(action, written)
        return Command(action, arguments, written.command_type.span) if arguments is not None else None

    def _action(self, written: WrittenCommand) -> Action | None:
        command_type, name = written.command_type, written.action
        if command_type.text not in CommandType.__members__:
            self._unknown(UNKNOWN_COMMAND_TYPE, "command type", command_type, CommandType.__members__)
        action = ACTIONS.get(name.text)
        if action is None:
            self._unknown(UNKNOWN_ACTION, "action", name, ACTIONS)
        elif command_type.text in CommandType.__members__ and command_type.text != action.command_type:
            self.report(
                WRONG_COMMAND_TYPE,
                command_type.span,
                f"{action.name} is no {command_type.text} action",
                f"write `command_type: {action.command_type}`",
            )
        return action

    def _own_arguments(self, action: Action, written: WrittenCommand) -> tuple[Argument, ...] | None:
        known = {parameter.name: parameter for parameter in action.parameters}
        given: dict[str, Value | None] = {}
        for item in written.parameters:
            parameter = known.get(item.name.text)
            if parameter is None:
                self._unknown(UNKNOWN_PARAMETER, f"parameter of {action.name}", item.name, known)
            elif parameter.name in given:
                self.report(REPEATED_PARAMETER, item.name.span, f"{parameter.name} is given twice")
            else:
                given[parameter.name] = self._value(
                    item, read_value(parameter.name, parameter.type, item.value.text, self.places)
                )
        for parameter in action.parameters:
            if parameter.required and parameter.name not in given:
                self._missing(action, written, f"`{parameter.name}`: {parameter.type}")
        arguments = [Argument(name, value) for name in known if (value := given.get(name)) is not None]
        return tuple(arguments) if len(arguments) == len(written.parameters) else None

    def _one_setting(self, action: Action, written: WrittenCommand) -> tuple[Argument, ...] | None:
        if not written.parameters:
            self._missing(action, written, "one of " + ", ".join(DRIVING_PARAMETERS))
            return None
        for item in written.parameters[1:]:
            self.report(
                NOT_ONE_SETTING,
                item.name.span,
                f"{action.name} takes exactly one driving parameter",
                "put this one into a command of its own",
            )
        item = written.parameters[0]
        value = self._setting(item) if action.arguments is Arguments.SETTING else self._adjustment(item)
        return (Argument(item.name.text, value),) if value is not None else None

    def _setting(self, item: WrittenParameter) -> Value | None:
        if item.name.text == "all":
            return self._value(item, read_value("all", Choice(("default",)), item.value.text, None))
        parameter = self._driving_parameter(item.name)
        return self._value(item, read_setting(parameter, item.value.text)) if parameter else None

    def _adjustment(self, item: WrittenParameter) -> Value | None:
        parameter = self._driving_parameter(item.name)
        if parameter is None:
            return None
        if isinstance(parameter.type, Choice):
            self.report(
                NOT_ADJUSTABLE,
                item.name.span,
                f"{parameter.name} is no number and can't be adjusted",
                f"use SET_PARAM with one of {', '.join(parameter.type.options)}",
            )
            return None
        return self._value(item, read_delta(parameter.name, parameter.type, item.value.text))

    def _driving_parameter(self, name: Written) -> DrivingParameter | None:
        parameter = DRIVING_PARAMETERS.get(name.text)
        if parameter is None:
            self._unknown(UNKNOWN_PARAMETER, "driving parameter", name, DRIVING_PARAMETERS)
        return parameter

    def _value(self, item: WrittenParameter, result: Value | Problem) -> Value | None:
        if isinstance(result, Problem):
            self.report(result.code, item.value.span, result.message, result.help)
            return None
        return result

    def _missing(self, action: Action, written: WrittenCommand, needed: str) -> None:
        self.report(MISSING_PARAMETER, written.action.span, f"{action.name} needs a parameter", f"add {needed}")

    def _unknown(self, code: Code, what: str, word: Written, known: Iterable[str]) -> None:
        self.report(code, word.span, f"`{word.text}` is no {what}", suggest(word.text, list(known)))
