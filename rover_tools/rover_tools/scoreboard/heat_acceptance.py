"""What the heat mission is accepted by, as a table in Markdown: wanted beside achieved."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from tabulate import tabulate

from rover_tools.scoreboard.figures import Share, Spread
from rover_tools.scoreboard.heat_table import HeatSummary

FILE = "acceptance.md"
NOTES = (
    "Shares are of all missions, with their 95 % confidence interval (Wilson); a mission that\n"
    "raised an error has achieved nothing. Three figures are mean / median / worst mission.\n"
    "**No** marks what is not met; a share is judged without its interval."
)


@dataclass(frozen=True)
class Criterion:
    """One figure of the table."""

    figure: str
    wanted: str
    shown: Callable[[HeatSummary], str]
    is_met: Callable[[HeatSummary], bool]


def _share(figure: str, heading: str, percent: float) -> Criterion:
    """At least so many of them."""

    def shares(summary: HeatSummary) -> Share:
        return summary.shares[heading]

    def is_met(summary: HeatSummary) -> bool:
        return 100.0 * shares(summary).count >= percent * shares(summary).total

    wanted = f"{percent:g} %" if percent < 100.0 else "all"
    return Criterion(figure, wanted, lambda summary: str(shares(summary)), is_met)


def _spread(
    figure: str, heading: str, wanted: str, good: Callable[[Spread], bool] = lambda _: True
) -> Criterion:
    """good: of the figure's mean, median and worst; what no mission has is not held against it."""

    def shown(summary: HeatSummary) -> str:
        spread, digits = summary.spreads[heading]
        return spread.shown(digits)

    def is_met(summary: HeatSummary) -> bool:
        spread, _ = summary.spreads[heading]
        return spread.is_empty or good(spread)

    return Criterion(figure, wanted, shown, is_met)


CRITERIA = (
    _share("whole mission: success", "success", 85.0),
    _share("all sources found, each within 0.15 m", "all sources found", 95.0),
    _share("sources found within 0.15 m", "sources found", 98.0),
    _spread("farthest source from its report [m]", "source error [m]", "-"),
    _share("no false source", "none false", 97.5),
    _share("each payload at a stand-off pose, facing, standing", "launches right", 95.0),
    _spread("farthest from a stand-off pose [m]", "launch error [m]", "-"),
    _spread("widest off the source [deg]", "launch angle [deg]", "-"),
    _share("no launch while moving", "launches standing", 100.0),
    _share("no early ascent: 0.15 m beyond the foot at most", "no early ascent", 100.0),
    _share("stands within 0.3 s of each interrupt", "stops in time", 100.0),
    _spread("longest stop [s]", "stop [s]", "-"),
    _share("ramp: stands on top, nothing touched, payload released", "ramp done", 95.0),
    _share("no contact", "no contact", 95.0),
    _share("one contact at most", "one contact at most", 100.0),
    _spread("map: cells within 0.05 m of a wall [%]", "walls right [%]", "97 in the mean",
            lambda spread: spread.mean >= 97.0),
    _spread("pose error, rms [cm]", "pose error [cm]", "3 in the mean",
            lambda spread: spread.mean <= 3.0),
    _spread("time [s]", "time [s]", "median 480", lambda spread: spread.median <= 480.0),
    _share("ended before the time limit", "in time", 100.0),
    _spread("times real time, one core", "real time", "median 5",
            lambda spread: spread.median >= 5.0),
    _spread("a tick's time, 99 % [ms]", "tick, p99 [ms]", "10 in the worst",
            lambda spread: spread.worst <= 10.0),
)  # fmt: skip


def acceptance_table(summaries: Sequence[HeatSummary]) -> str:
    """One column per parameters and family; what is not met is marked."""
    rows = [
        [each.figure, each.wanted, *(_cell(each, summary) for summary in summaries)]
        for each in CRITERIA
    ]
    headings = [f"{s.parameters}, {s.group}: {s.missions} missions" for s in summaries]
    table = tabulate(
        rows, headers=["figure", "wanted", *headings], tablefmt="github", disable_numparse=True
    )
    return f"{table}\n\n{NOTES}\n"


def _cell(criterion: Criterion, summary: HeatSummary) -> str:
    return criterion.shown(summary) + ("" if criterion.is_met(summary) else " **No**")
