"""Saves a program's state now and then, beside its work."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait

from rover_common.saved_state import SavedState, StateFile

PERIOD = 1.0  # [s] of wall time between two copies: what a killed program forgets at most

MakeState = Callable[[], SavedState]


class StateKeeper:
    """Takes a snapshot when one is due, and writes it in a thread.

    Where the disk is slow, the next one comes later: at most one is being written.
    """

    def __init__(
        self, file: StateFile, warn: Callable[[str], None], period: float = PERIOD
    ) -> None:
        """`warn` is called once with a line when a file cannot be written."""
        self._file = file
        self._warn = warn
        self._period = period
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="state")
        self._writing: Future[None] | None = None
        self._written = -period  # [s] when the last one was begun
        self._urgent = False
        self._warned = False

    def keep(self, snapshot: Callable[[], MakeState], at_once: bool = False) -> None:
        """Call it once per frame; `snapshot` is called only when a copy is due.

        It copies what goes on changing, and returns what makes the state of it in the thread.
        at_once: something has happened that must not be forgotten.
        """
        now = time.monotonic()
        self._urgent |= at_once
        if self._busy or not (self._urgent or now - self._written >= self._period):
            return
        self._written, self._urgent = now, False
        self._writing = self._pool.submit(self._write, snapshot())

    def keep_first(self, snapshot: Callable[[], MakeState], seconds: float = PERIOD) -> None:
        """Before something is done that must never be done twice: wait until a copy is written.

        At most so long [s]: a disk that hangs holds up nothing.
        """
        self._written, self._urgent = time.monotonic(), False
        self._writing = self._pool.submit(self._write, snapshot())
        wait([self._writing], seconds)

    def close(self, snapshot: Callable[[], MakeState] | None = None) -> None:
        """Write the last one, unless there is none, and end the thread."""
        if snapshot is not None:
            self._pool.submit(self._write, snapshot())
        self._pool.shutdown(wait=True)

    @property
    def _busy(self) -> bool:
        return self._writing is not None and not self._writing.done()

    def _write(self, make: MakeState) -> None:
        """In the thread."""
        try:
            self._file.write(make())
        except Exception as error:  # whatever it is: nobody asks this thread how it ended
            if not self._warned:
                self._warned = True
                self._warn(f"the state cannot be saved: {error!r:.200}")
