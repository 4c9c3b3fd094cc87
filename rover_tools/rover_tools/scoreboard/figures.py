"""How missions are counted and measured in a scoreboard's table."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from scipy.stats import binomtest

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Share:
    """How many of all achieved it, with Wilson's confidence interval."""

    count: int
    total: int
    low: float  # 0..1
    high: float  # 0..1

    @classmethod
    def of(cls, successes: Iterable[bool]) -> Share:
        """Of missions, or of what is in them."""
        done = list(successes)
        return cls.counted(sum(done), len(done))

    @classmethod
    def counted(cls, count: int, total: int) -> Share:
        """Of none at all, anything is possible."""
        if total == 0:
            return cls(0, 0, 0.0, 1.0)
        interval = binomtest(count, total).proportion_ci(CONFIDENCE, method="wilson")
        return cls(count, total, float(interval.low), float(interval.high))

    def __str__(self) -> str:
        return f"{self.count} of {self.total} ({100 * self.low:.0f}-{100 * self.high:.0f} %)"


@dataclass(frozen=True)
class Spread:
    """Of the missions that have this figure; all NaN when none has."""

    mean: float
    median: float
    worst: float

    @classmethod
    def of(cls, values: Iterable[float | None], worst: Callable[[list[float]], float]) -> Spread:
        """worst: min where more is better, max where less is."""
        known = [float(value) for value in values if value is not None]
        if not known:
            return cls(np.nan, np.nan, np.nan)
        return cls(float(np.mean(known)), float(np.median(known)), worst(known))

    @property
    def is_empty(self) -> bool:
        """No mission has the figure."""
        return bool(np.isnan(self.mean))

    def shown(self, digits: int) -> str:
        """Mean / median / worst."""
        if self.is_empty:
            return "-"
        return " / ".join(f"{value:.{digits}f}" for value in (self.mean, self.median, self.worst))
