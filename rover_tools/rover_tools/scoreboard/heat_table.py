"""The figures by which the heat mission is accepted: one row per parameters and family."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rover_tools.evaluation.results import Result
from rover_tools.scoreboard.figures import Share, Spread
from rover_tools.scoreboard.store import Entry

EARLY_ASCENT = 0.15  # [m] of the axle beyond the foot before the ramp is attempted, at most
STOP_SECONDS = 0.3  # [s] from a tilt interrupt to a robot that stands, at most

LEGEND = (
    "Shares are of all missions, with their 95 % confidence interval (Wilson); a mission that\n"
    "failed has achieved nothing. Three figures are mean / median / worst. Real time: simulated\n"
    "time over the time of one core."
)


@dataclass(frozen=True)
class HeatSummary:
    """Of one set of parameters in one family of mazes."""

    parameters: str
    group: str
    missions: int
    failed: int  # raised
    shares: dict[str, Share]  # by heading
    spreads: dict[str, tuple[Spread, int]]  # by heading, with the digits to show

    @classmethod
    def of(cls, parameters: str, group: str, entries: Sequence[Entry]) -> HeatSummary:
        rows = [entry.result for entry in entries]
        ended = [entry.result for entry in entries if not entry.failed]

        def share(achieved: Callable[[Result], bool], among: Sequence[Entry] = entries) -> Share:
            return Share.of(not entry.failed and achieved(entry.result) for entry in among)

        with_ramp = [entry for entry in entries if entry.failed or has_ramp(entry.result)]
        sources = sum(row["sources_total"] for row in ended)
        return cls(
            parameters,
            group,
            missions=len(rows),
            failed=len(rows) - len(ended),
            shares={
                "success": share(lambda row: row["success"]),
                "all sources found": share(found_all),
                "sources found": Share.counted(sum(r["sources_found"] for r in ended), sources),
                "none false": share(lambda row: row["sources_false"] == 0),
                "all delivered": share(lambda r: r["delivered"] == r["sources_total"]),
                "launches right": share(lambda row: row["launches_wrong"] == 0),
                "launches standing": share(lambda row: row["launches_moving"] == 0),
                "no early ascent": share(lambda row: row["early_ascent"] <= EARLY_ASCENT),
                "stops in time": share(stops_in_time),
                "ramp done": share(lambda row: row["ramp_done"], with_ramp),
                "no contact": share(lambda row: row["contacts"] == 0),
                "one contact at most": share(lambda row: row["contacts"] <= 1),
                "in time": share(lambda row: row["in_time"]),
                "done": share(lambda row: row["done"]),
            },
            spreads=_spreads(rows),
        )

    def cells(self) -> dict[str, str]:
        """What is shown, by its heading."""
        missions = f"{self.missions}" + (f", {self.failed} failed" if self.failed else "")
        return {
            "parameters": self.parameters,
            "mazes": self.group,
            "missions": missions,
            **{heading: str(share) for heading, share in self.shares.items()},
            **{heading: spread.shown(n) for heading, (spread, n) in self.spreads.items()},
        }


def _spreads(rows: Sequence[Result]) -> dict[str, tuple[Spread, int]]:
    """By heading, with the digits to show."""

    def spread(key: str, worst: Callable[[list[float]], float], scale: float = 1.0) -> Spread:
        known = (row[key] for row in rows if row[key] is not None)
        return Spread.of((scale * value for value in known), worst)

    return {
        "time [s]": (spread("time", max), 0),
        "source error [m]": (spread("source_error_max", max), 3),
        "launch error [m]": (spread("launch_error_max", max), 3),
        "launch angle [deg]": (spread("launch_angle_max", max), 1),
        "pose error [cm]": (spread("pose_rmse", max, 100.0), 1),
        "walls right [%]": (spread("walls_right", min), 1),
        "walls mapped [%]": (spread("walls_mapped", min), 1),
        "contacts": (spread("contacts", max), 1),
        "interrupts": (spread("interrupts", max), 1),
        "stop [s]": (spread("stop_seconds_max", max), 2),
        "distance [m]": (spread("distance", max), 0),
        "real time": (spread("times_real_time", min), 1),
        "tick, p99 [ms]": (spread("tick_ms_p99", max), 1),
    }


def found_all(row: Result) -> bool:
    return bool(row["sources_found"] == row["sources_total"])


def stops_in_time(row: Result) -> bool:
    """After every interrupt; also without one."""
    seconds = row["stop_seconds_max"]
    return seconds is None or bool(seconds <= STOP_SECONDS)


def has_ramp(row: Result) -> bool:
    return row["ramp_done"] is not None
