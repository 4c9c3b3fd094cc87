"""Whether the next frame may be made, and what is to be done before it, by other threads."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

Task = Callable[[], None]


class StepGate:
    """Open, closed, or open for so many frames.

    The simulation's thread calls `opens` and `attend`; any other thread may call the rest.
    """

    def __init__(self, closed: bool = False) -> None:
        self._changed = threading.Condition()
        self._closed = closed
        self._steps = 0  # frames that may pass while it is closed
        self._resting = False  # the simulation asked, and was held up
        self._tasks: deque[Task] = deque()

    @property
    def closed(self) -> bool:
        return self._closed

    def opens(self) -> bool:
        """Before each frame: whether it may be made now."""
        self.attend()
        with self._changed:
            passes = not self._closed or self._steps > 0
            self._steps = max(0, self._steps - 1)
            self._resting = not passes
            self._changed.notify_all()
            return passes

    def attend(self) -> None:
        """Do what waits to be done, between two frames."""
        while True:
            with self._changed:
                if not self._tasks:
                    return
                task = self._tasks.popleft()
            task()

    def close(self, closed: bool) -> None:
        """Let no further frame pass, or let them pass again."""
        with self._changed:
            self._closed, self._steps, self._resting = closed, 0, False

    def step(self, count: int, timeout: float) -> bool:
        """Let so many frames pass while it is closed; whether they were made within so long [s]."""
        with self._changed:
            self._steps, self._resting = count, False
            done = self._changed.wait_for(lambda: self._steps == 0 and self._resting, timeout)
            self._steps = 0
            return done

    def do(self, task: Task, timeout: float) -> bool:
        """Have a task done in the simulation's thread; whether it was within so long [s].

        Raises what the task raises.
        """
        done, errors = threading.Event(), []

        def run() -> None:
            try:
                task()
            except Exception as error:
                errors.append(error)
            done.set()

        with self._changed:
            self._tasks.append(run)
        finished = done.wait(timeout)
        if errors:
            raise errors[0]
        return finished
