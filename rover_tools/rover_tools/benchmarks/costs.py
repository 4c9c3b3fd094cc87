"""What frames and plans cost, by two clocks."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from rover_tools.evaluation.results import Result

COLUMNS = {"median": 50, "p99": 99, "max": 100}  # percentiles


class Stopwatch:
    """Times of something that is done again and again."""

    def __init__(self) -> None:
        self.laps: list[tuple[float, float]] = []  # [s] wall, thread

    @contextmanager
    def lap(self) -> Iterator[None]:
        """Time what is done inside."""
        wall, thread = time.perf_counter(), time.thread_time()
        try:
            yield
        finally:
            self.laps.append((time.perf_counter() - wall, time.thread_time() - thread))

    def result(self, name: str) -> Result:
        """Percentiles [ms]."""
        times = np.array(self.laps) * 1000.0
        return {
            f"{name}{clock}_ms_{column}": round(float(np.percentile(times[:, index], percent)), 3)
            for index, clock in enumerate(("", "_thread"))
            for column, percent in COLUMNS.items()
        }


class Costs:
    """Of all missions, or of one."""

    def __init__(self) -> None:
        self.frames, self.plans = Stopwatch(), Stopwatch()
        self.planned = threading.Event()  # unset from the request of a plan until it is made
        self.planned.set()
        self._spans: list[tuple[int, int]] = []  # frames and plans until the end of each

    def mark_span(self) -> None:
        """A span of the mission is over."""
        self._spans.append((len(self.frames.laps), len(self.plans.laps)))

    def frame_ms_by_span(self) -> list[float]:
        """[ms] that the threads worked per frame, its share of the plans included."""
        frames, plans = (np.array(watch.laps) * 1000.0 for watch in (self.frames, self.plans))
        ms, begin = [], (0, 0)
        for end in self._spans:
            work = frames[begin[0] : end[0], 1].sum() + plans[begin[1] : end[1], 1].sum()
            ms.append(round(float(work) / (end[0] - begin[0]), 2))
            begin = end
        return ms
