"""Keys of a terminal, one by one, without echo."""

from __future__ import annotations

import os
import select
import termios
import tty
from types import TracebackType
from typing import Self

from rover_common.errors import RoverError

MOST_BYTES = 1024  # read at once


class NoTerminalError(RoverError):
    """The input is no terminal."""


class Terminal:
    """Within the `with` block keys come at once; afterwards the terminal is as it was."""

    def __init__(self, descriptor: int) -> None:
        """Raises NoTerminalError for a file that is none."""
        if not os.isatty(descriptor):
            raise NoTerminalError("the keys come from a terminal, and the input is none")
        self._descriptor = descriptor

    def read(self, timeout: float) -> bytes:
        """What was typed within the timeout [s]; empty when nothing was."""
        ready, _, _ = select.select([self._descriptor], [], [], timeout)
        return os.read(self._descriptor, MOST_BYTES) if ready else b""

    def __enter__(self) -> Self:
        self._before = termios.tcgetattr(self._descriptor)
        tty.setcbreak(self._descriptor)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        termios.tcsetattr(self._descriptor, termios.TCSADRAIN, self._before)
