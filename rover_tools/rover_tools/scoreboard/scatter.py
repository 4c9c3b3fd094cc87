"""The time of each mission against the oracle's, as points in per cent of a square."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from matplotlib.ticker import MaxNLocator

from rover_tools.report.plots import Tick
from rover_tools.scoreboard.rover_table import has_all_samples, is_home
from rover_tools.scoreboard.store import Entry

RATIOS = (1, 2, 3, 4)  # lines of so many times the oracle's time
KINDS = 7  # strategies that differ in shape and colour


@dataclass(frozen=True)
class Point:
    """One mission."""

    x: float  # [%] from the left
    y: float  # [%] from the bottom
    kind: int  # of its strategy
    achieved: bool  # home with all samples
    text: str
    link: str | None


@dataclass(frozen=True)
class Ray:
    """Where the time is so many times the oracle's: from one point to another [%]."""

    ratio: int
    start: tuple[float, float]
    end: tuple[float, float]


@dataclass(frozen=True)
class Axis:
    """A range of values with ticks at its ends."""

    ticks: tuple[float, ...]

    @classmethod
    def of(cls, values: list[float]) -> Axis:
        low, high = min(values), max(values)
        margin = 0.1 * (high - low) + 1.0
        locator = MaxNLocator(5, steps=[1, 2, 5, 10])
        return cls(tuple(map(float, locator.tick_values(max(0.0, low - margin), high + margin))))

    @property
    def low(self) -> float:
        return self.ticks[0]

    @property
    def high(self) -> float:
        return self.ticks[-1]

    def at(self, value: float) -> float:
        """[%]"""
        return 100 * (value - self.low) / (self.high - self.low)

    def labels(self) -> tuple[Tick, ...]:
        return tuple(Tick(self.at(value), f"{value:g}") for value in self.ticks)


@dataclass(frozen=True)
class Scatter:
    """All missions that ended."""

    points: tuple[Point, ...]
    strategies: tuple[str, ...]  # by kind
    x_ticks: tuple[Tick, ...]
    y_ticks: tuple[Tick, ...]
    rays: tuple[Ray, ...]


def scatter_of(entries: Sequence[Entry]) -> Scatter | None:
    """None without a mission that ended."""
    ended = [entry for entry in entries if not entry.failed]
    if not ended:
        return None
    strategies = sorted({entry.strategy for entry in ended})
    x = Axis.of([entry.result["oracle_time"] for entry in ended])
    y = Axis.of([entry.result["time"] for entry in ended])
    points = tuple(
        Point(
            x.at(entry.result["oracle_time"]),
            y.at(entry.result["time"]),
            strategies.index(entry.strategy) % KINDS,
            is_home(entry.result) and has_all_samples(entry.result),
            f"{entry.name}: {entry.result['time']:.0f} s",
            entry.report,
        )
        for entry in ended
    )
    return Scatter(points, tuple(strategies), x.labels(), y.labels(), tuple(_rays(x, y)))


def _rays(x: Axis, y: Axis) -> Iterator[Ray]:
    """Those that cross the square, cut at its edges."""
    for ratio in RATIOS:
        first, last = max(x.low, y.low / ratio), min(x.high, y.high / ratio)
        if first < last:
            start, end = ((x.at(each), y.at(ratio * each)) for each in (first, last))
            yield Ray(ratio, start, end)
