"""The edge of every command: what it raises becomes one line and an exit code."""

from __future__ import annotations

import math
import signal
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import click

from rover_common.errors import RoverError

FAILED = 1  # exit code after an expected error
STOPPED = 130  # exit code after Ctrl-C, SIGTERM or SIGHUP


class Whole(click.IntRange):
    """An integer within a range."""

    def _describe_range(self) -> str:
        return _in_words(self)


class Real(click.FloatRange):
    """A finite number within a range; click's own comparison lets NaN pass."""

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        number = super().convert(value, param, ctx)
        if not math.isfinite(number):
            self.fail(f"{value} is not in the range {self._describe_range()}.", param, ctx)
        return number

    def _describe_range(self) -> str:
        return _in_words(self)


def _in_words(bounds: click.IntRange | click.FloatRange) -> str:
    """A range for help and for messages; click itself writes 0.0<x<=50.0."""
    low = f"above {bounds.min:g}" if bounds.min_open else f"{bounds.min:g}"
    if bounds.max is None:
        return low if bounds.min_open else f"{low} or more"
    return f"{low}, at most {bounds.max:g}" if bounds.min_open else f"{low} to {bounds.max:g}"


def run_command(command: click.Command, name: str, arguments: Sequence[str]) -> int:
    """Parse the arguments, run the command, and return the exit code.

    0, or what the command itself returns; 1 after a RoverError or an OSError, 2 for arguments that
    cannot be used, 130 when it was interrupted. Any other exception is a defect and passes through.
    """
    try:
        with _signals_interrupt():
            code = command.main(list(arguments), prog_name=name, standalone_mode=False)
    except click.ClickException as error:
        path = error.ctx.command_path if isinstance(error, click.UsageError) and error.ctx else name
        return _report(path, f"{error.format_message()} ({path} --help)", error.exit_code)
    except click.Abort:
        return _report(command_path(command, name, arguments), "stopped", STOPPED)
    except OSError as error:
        return _report(command_path(command, name, arguments), _text_of(error), FAILED)
    except RoverError as error:
        return _report(command_path(command, name, arguments), str(error), FAILED)
    return code if isinstance(code, int) else 0


def command_path(command: click.Command, name: str, arguments: Sequence[str]) -> str:
    """The names of the command that the arguments call, as in `rover bench graph`."""
    for argument in arguments:
        if not isinstance(command, click.Group):
            break
        called = command.get_command(click.Context(command), argument)
        if called is None:
            break
        command, name = called, f"{name} {argument}"
    return name


@contextmanager
def _signals_interrupt() -> Iterator[None]:
    """SIGTERM and SIGHUP end the processes of a run like Ctrl-C; nohup stays deaf to SIGHUP."""
    numbers = [
        number
        for number in (signal.SIGTERM, signal.SIGHUP)
        if signal.getsignal(number) is not signal.SIG_IGN
    ]
    before = [signal.signal(number, signal.default_int_handler) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)


def _text_of(error: OSError) -> str:
    """Without the number that Python puts first."""
    if error.strerror is None:
        return str(error)
    return error.strerror if error.filename is None else f"{error.filename}: {error.strerror}"


def _report(path: str, text: str, code: int) -> int:
    click.echo(f"{path}: {text}", err=True)
    return code
