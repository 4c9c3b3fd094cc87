"""How long a node's ticks take."""

from __future__ import annotations

import time
from collections.abc import Callable
from types import TracebackType


class TickTimes:
    """Measures what is done within `with ticks:`, until `take`."""

    def __init__(self, clock: Callable[[], float] = time.perf_counter) -> None:
        """clock: of wall time [s]."""
        self._clock = clock
        self._began = 0.0  # [s]
        self._times: list[float] = []  # [s] since the last `take`

    def __enter__(self) -> None:
        self._began = self._clock()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._times.append(self._clock() - self._began)

    def take(self) -> tuple[float, float] | None:
        """Mean and longest [s] since the last call; None where there was no tick."""
        times, self._times = self._times, []
        return (sum(times) / len(times), max(times)) if times else None
