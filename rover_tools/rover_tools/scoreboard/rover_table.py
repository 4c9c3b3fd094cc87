"""The rover's figures: one row per strategy and group of worlds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rover_tools.evaluation.results import Result
from rover_tools.scoreboard.figures import Share, Spread
from rover_tools.scoreboard.store import Entry

HOME_WITHIN = 2.0  # [m] of the start, as missions are scored; the rover itself aims for less


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
            "mapped [%]": self.mapped.shown(1),
            "fidelity [%]": self.fidelity.shown(1),
            "time [s]": self.time.shown(0),
            "time / oracle": self.oracle_ratio.shown(2),
            "distance [m]": self.distance.shown(0),
            "contacts": self.contacts.shown(1),
            "recoveries": self.recoveries.shown(1),
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


LEGEND = (
    "Three figures are mean / median / worst; in brackets, the 95 % confidence interval (Wilson).\n"
    "Home: reports it, and is within 2 m of its start. Time / oracle: of those that came home."
)
