"""Plots over time, as lines in a square of 1000 x 100 that the page stretches."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.ticker import MaxNLocator

from rover_tools.report.mission_log import TrackPoint
from rover_tools.report.track import StateChange

WIDTH, HEIGHT = 1000.0, 100.0


@dataclass(frozen=True)
class Tick:
    """A labelled value of an axis."""

    at: float  # [%] from the left or from the bottom
    text: str


@dataclass(frozen=True)
class Line:
    """One line of a plot."""

    kind: str  # its name, and its class in the style sheet
    points: str  # the attribute `points` of a polyline
    values: tuple[float | None, ...]  # for the readout, one per point of the track


@dataclass(frozen=True)
class Plot:
    """One or more values over the mission's time."""

    title: str
    digits: int  # of the readout
    lines: tuple[Line, ...]
    ticks: tuple[Tick, ...]


@dataclass(frozen=True)
class Span:
    """A stay in one state."""

    state: str
    start: float  # [%] of the duration, from the left
    width: float  # [%]
    seconds: float
    reason: str


def plots_of(track: Sequence[TrackPoint]) -> list[Plot]:
    """The rover's, over its mission; none without a track."""
    if not track:
        return []
    times = [point.time for point in track]

    def plot(title: str, digits: int, **lines: Sequence[float | None]) -> Plot:
        return plot_of(title, digits, times, lines)

    plots = [
        plot("Speed [m/s]", 2, speed=[p.speed for p in track]),
        plot("Largest tilt [°]", 1, tilt=[math.degrees(p.tilt) for p in track]),
    ]
    if any(point.percent_mapped is not None for point in track):
        mapped, fidelity = [p.percent_mapped for p in track], [p.fidelity for p in track]
        plots.append(plot("Mapped, fidelity [%]", 1, mapped=mapped, fidelity=fidelity))
    elif any(point.mapped_area is not None for point in track):
        plots.append(plot("Mapped ground [m²]", 0, mapped=[p.mapped_area for p in track]))
    plots.append(
        plot("Explored, as the rover estimates [%]", 1, explored=[p.explored for p in track])
    )
    plots.append(plot("Samples on board", 0, samples=[float(p.samples) for p in track]))
    plots.append(plot("Distance home [m]", 1, home=[p.home_distance for p in track]))
    return plots


def plot_of(
    title: str,
    digits: int,
    times: Sequence[float],
    values: dict[str, Sequence[float | None]],
    least: float = 1.0,
) -> Plot:
    """Lines by their names over times [s]; the axis reaches from 0 to `least` at least."""
    known = [value for line in values.values() for value in line if value is not None]
    ticks = MaxNLocator(4, steps=[1, 2, 5, 10]).tick_values(
        min([0.0, *known]), max([least, *known])
    )
    low, high = float(ticks[0]), float(ticks[-1])

    def height(value: float) -> float:
        return 100.0 * (value - low) / (high - low)

    lines = tuple(
        Line(kind, _points(times, [None if v is None else height(v) for v in line]),
             tuple(None if v is None else round(v, 3) for v in line))
        for kind, line in values.items()
    )  # fmt: skip
    return Plot(title, digits, lines, tuple(Tick(height(v), f"{v:g}") for v in ticks))


def time_ticks(duration: float) -> tuple[Tick, ...]:
    """Seconds, at round values."""
    values = MaxNLocator(6, steps=[1, 2, 3, 5, 6, 10]).tick_values(0.0, max(duration, 1.0))
    return tuple(Tick(100 * v / duration, f"{v:g}") for v in values if 0 <= v <= duration)


def spans_of(changes: Sequence[StateChange], duration: float) -> list[Span]:
    """The stays in the states, one after another."""
    ends = [*(change.time for change in changes[1:]), duration]
    return [
        Span(
            change.state,
            100 * change.time / duration,
            100 * max(0.0, end - change.time) / duration,
            max(0.0, end - change.time),
            change.reason,
        )
        for change, end in zip(changes, ends, strict=False)
    ]


def seconds_by_state(spans: Sequence[Span]) -> dict[str, float]:
    """The longest first [s]."""
    seconds: dict[str, float] = {}
    for span in spans:
        seconds[span.state] = seconds.get(span.state, 0.0) + span.seconds
    return dict(sorted(seconds.items(), key=lambda item: -item[1]))


def _points(times: Sequence[float], heights: Sequence[float | None]) -> str:
    duration = max(times[-1], 1e-9)
    return " ".join(
        f"{WIDTH * time / duration:.1f},{HEIGHT - height:.1f}"
        for time, height in zip(times, heights, strict=True)
        if height is not None
    )
