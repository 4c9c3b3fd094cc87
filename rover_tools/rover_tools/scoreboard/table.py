"""The scoreboard's figures: one row per strategy and group of worlds."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import binomtest
from tabulate import tabulate

from rover_tools.evaluation.results import Result
from rover_tools.scoreboard.store import Entry

CONFIDENCE = 0.95
HOME_WITHIN = 2.0  # [m] of the start, as missions are scored; the rover itself aims for less


@dataclass(frozen=True)
class Share:
    """How many of all missions achieved it, with Wilson's confidence interval."""

    count: int
    total: int
    low: float  # 0..1
    high: float  # 0..1

    @classmethod
    def of(cls, successes: Iterable[bool]) -> Share:
        """Of at least one mission."""
        done = list(successes)
        test = binomtest(sum(done), len(done))
        interval = test.proportion_ci(CONFIDENCE, method="wilson")
        return cls(sum(done), len(done), float(interval.low), float(interval.high))

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


@dataclass(frozen=True)
class Summary:
    """Of one strategy in one group of worlds."""

    strategy: str
    group: str
    missions: int
    failed: int  # raised, and count as neither home nor with all samples
    home: Share
    all_samples: Share
    mapped: Spread  # [%]
    fidelity: Spread  # [%]
    time: Spread  # [s] simulated
    oracle_ratio: Spread  # of a mission's time to the oracle's
    distance: Spread  # [m]
    contacts: Spread
    recoveries: Spread

    @classmethod
    def of(cls, strategy: str, group: str, entries: Sequence[Entry]) -> Summary:
        rows = [entry.result for entry in entries]

        def spread(key: str, worst: Callable[[list[float]], float]) -> Spread:
            return Spread.of((row[key] for row in rows), worst)

        return cls(
            strategy,
            group,
            missions=len(rows),
            failed=sum(entry.failed for entry in entries),
            home=Share.of(is_home(row) for row in rows),
            all_samples=Share.of(has_all_samples(row) for row in rows),
            mapped=spread("percent_mapped", min),
            fidelity=spread("fidelity", min),
            time=spread("time", max),
            oracle_ratio=Spread.of((oracle_ratio(row) for row in rows), max),
            distance=spread("distance", max),
            contacts=spread("contacts", max),
            recoveries=spread("recoveries", max),
        )

    def cells(self) -> dict[str, str]:
        """What is shown, by its heading."""
        return {
            "strategy": self.strategy,
            "worlds": self.group,
            "missions": f"{self.missions}" + (f", {self.failed} failed" if self.failed else ""),
            "home": str(self.home),
            "all samples": str(self.all_samples),
            "mapped [%]": _shown(self.mapped, 1),
            "fidelity [%]": _shown(self.fidelity, 1),
            "time [s]": _shown(self.time, 0),
            "time / oracle": _shown(self.oracle_ratio, 2),
            "distance [m]": _shown(self.distance, 0),
            "contacts": _shown(self.contacts, 1),
            "recoveries": _shown(self.recoveries, 1),
        }


def is_home(row: Result) -> bool:
    """The rover reports it, and it is near its start."""
    return bool(row["done"]) and row["home_distance"] <= HOME_WITHIN


def has_all_samples(row: Result) -> bool:
    """False for a mission that failed."""
    collected = row["samples_collected"]
    return collected is not None and collected == row["samples_total"]


def oracle_ratio(row: Result) -> float | None:
    """How many times as long as the oracle it took to come home; None for one that did not."""
    return row["time"] / row["oracle_time"] if is_home(row) else None


def summaries(entries: Sequence[Entry]) -> list[Summary]:
    """By group of worlds, then by strategy."""
    kinds = sorted({(entry.group, str(entry.settings["strategy"])) for entry in entries})
    return [
        Summary.of(
            strategy,
            group,
            [e for e in entries if (e.group, e.settings["strategy"]) == (group, strategy)],
        )
        for group, strategy in kinds
    ]


def as_text(rows: Sequence[Summary]) -> str:
    """One column per strategy and group, so that many of them fit beside each other."""
    cells = [row.cells() for row in rows]
    if not cells:
        return "no missions"
    lines = [[heading, *(column[heading] for column in cells)] for heading in cells[0]]
    return tabulate(lines[1:], headers=lines[0], disable_numparse=True) + f"\n\n{LEGEND}"


LEGEND = (
    "Three figures are mean / median / worst; in brackets, the 95 % confidence interval (Wilson).\n"
    "Home: reports it, and is within 2 m of its start. Time / oracle: of those that came home."
)


def _shown(spread: Spread, digits: int) -> str:
    if np.isnan(spread.mean):
        return "-"
    return f"{spread.mean:.{digits}f} / {spread.median:.{digits}f} / {spread.worst:.{digits}f}"
