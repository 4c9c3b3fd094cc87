"""The progress of a run: a bar on a terminal, elsewhere a line now and then."""

from __future__ import annotations

import time
from collections.abc import Callable
from types import TracebackType

from tqdm import tqdm

from rover_tools.output import note

LINE_SECONDS = 10.0  # [s] of wall time between two lines where there is no terminal


class Progress:
    """How much of a total is done, and a text about it."""

    def __init__(
        self, total: float, unit: str, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._total, self._unit, self._clock = total, unit, clock
        # disable=None: no bar where standard error is not a terminal.
        layout = "{desc} {n:.0f}/{total:.0f} {unit}"
        self._bar = tqdm(total=total, unit=unit, disable=None, bar_format=layout)
        self._next_line = clock() + LINE_SECONDS

    def show(self, done: float, text: str) -> None:
        """Show the state; may be called as often as it changes."""
        if not self._bar.disable:
            self._bar.n = done
            self._bar.set_description_str(text)
        elif self._clock() >= self._next_line:
            self._next_line = self._clock() + LINE_SECONDS
            note(f"{text} {done:.0f}/{self._total:.0f} {self._unit}")

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._bar.close()
