"""What the commands share: lazy loading, errors, output, loading of maps and models."""

import json
import sys
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from functools import wraps
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple, NoReturn, ParamSpec, TypeVar

import click
from rich.console import Console
from rich.markup import escape

FAILED, BAD_INPUT = 1, 2
MAX_SOURCE_BYTES = 64 * 1024

P = ParamSpec("P")
R = TypeVar("R")

errors = Console(stderr=True, highlight=False)


class LazyCommand(NamedTuple):
    """A command that isn't imported yet.

    Attributes:
        module: Where it is defined.
        name: Its name there.
        summary: What the list of commands says about it.
    """

    module: str
    name: str
    summary: str


class LazyGroup(click.Group):
    """A group that imports a command only when it is used, so that ``wayword grammar`` need not load a simulator."""

    def __init__(self, *args: Any, lazy: dict[str, LazyCommand], **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._lazy = lazy

    def main(self, args: Sequence[str] | None = None, *rest: Any, **extra: Any) -> Any:
        """Runs the command line, with bad usage as a JSON object where ``--json`` asks for one."""
        words = list(sys.argv[1:] if args is None else args)
        try:
            if "--json" not in words:
                return super().main(words, *rest, **extra)
            status = super().main(words, *rest, **{**extra, "standalone_mode": False})
        except click.ClickException as error:
            fail(error.format_message(), as_json=True)
        except OSError as error:  # standard output is full, or gone
            errors.print(f"[bold red]error:[/] can't write: {escape(str(error))}")
            sys.exit(FAILED)
        sys.exit(status if isinstance(status, int) else 0)

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """Names of the commands, in the order of their declaration."""
        return list(self._lazy)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Imports a command."""
        lazy = self._lazy.get(cmd_name)
        if lazy is None:
            return None
        command = getattr(import_module(lazy.module), lazy.name)
        assert isinstance(command, click.Command)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Lists the commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, lazy.summary) for name, lazy in self._lazy.items()])


def json_option(command: Callable[P, R]) -> Callable[P, R]:
    """Adds ``--json``."""
    option = click.option(
        "--json",
        "as_json",
        is_flag=True,
        help="Print exactly one JSON object on standard output, for machines.",
    )
    return option(command)


def map_option(command: Callable[P, R]) -> Callable[P, R]:
    """Adds ``--map``."""
    option = click.option("--map", "map_name", default="town", show_default=True, help="Map: a name or a YAML file.")
    return option(command)


def model_options(command: Callable[P, R]) -> Callable[P, R]:
    """Adds ``--model`` and ``--adapter``."""
    model = click.option(
        "--model", envvar="WAYWORD_MODEL", help="GGUF file of a language model (default: the embedded one)."
    )
    adapter = click.option(
        "--adapter",
        envvar="WAYWORD_ADAPTER",
        help="GGUF file of a LoRA adapter, or none (default: Wayword's own for the embedded model).",
    )
    return model(adapter(command))


def friendly_errors(*expected: type[Exception]) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Turns expected exceptions into a message and exit status 2: users never see a traceback."""

    def decorate(command: Callable[P, R]) -> Callable[P, R]:
        @wraps(command)
        def run(*args: P.args, **kwargs: P.kwargs) -> R:
            try:
                return command(*args, **kwargs)
            except expected as error:
                fail(str(error), as_json=bool(kwargs.get("as_json")))

        return run

    return decorate


def fail(message: str, *, as_json: bool) -> NoReturn:
    """Ends with exit status 2 and a message."""
    if as_json:
        print_json({"error": message})
    errors.print(f"[bold red]error:[/] {escape(message)}", soft_wrap=True)
    sys.exit(BAD_INPUT)


def print_json(value: object) -> None:
    """Prints one JSON object on standard output."""
    click.echo(json.dumps(value, ensure_ascii=False, indent=2))


def make_folder(out: Path) -> None:
    """Makes the folder that results go to; better to fail now than after the work.

    Raises:
        click.BadParameter: It can't be made.
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise click.BadParameter(
            f"can't make the folder {out} ({error.strerror}); name another one", param_hint="--out"
        ) from error


def read_source(source: str, *, as_json: bool) -> str:
    """Reads a program from a file, or from standard input where the name is ``-``."""
    try:
        with nullcontext(sys.stdin.buffer) if source == "-" else Path(source).open("rb") as file:
            content = file.read(MAX_SOURCE_BYTES + 1)
    except OSError as error:
        fail(f"{source}: {error.strerror}", as_json=as_json)
    if len(content) > MAX_SOURCE_BYTES:
        fail(f"{source}: a program has at most 4 commands, this is more than {MAX_SOURCE_BYTES} bytes", as_json=as_json)
    try:
        return content.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError:
        fail(f"{source}: is not UTF-8 text", as_json=as_json)
