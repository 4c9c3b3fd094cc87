"""The report of one mission, of either robot: one HTML file, which needs no network."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from rover_tools.evaluation.results import Result
from rover_tools.report.map_layers import Drawing
from rover_tools.report.pages import render
from rover_tools.report.plots import Plot, Span, seconds_by_state, spans_of, time_ticks
from rover_tools.report.track import Point, StateChange
from rover_tools.report.video.snapshot import Video


@dataclass(frozen=True)
class Key:
    """An entry of a map's legend: with a colour, or a symbol in its text."""

    text: str
    colour: str = ""  # its name in the style sheet


@dataclass(frozen=True)
class MapPanel:
    """A map with its heading and its legend."""

    title: str
    drawing: Drawing
    legend: tuple[Key, ...]
    style: str = ""  # a class of the map
    states: bool = False  # whether the legend has the states and their times as well


@dataclass(frozen=True)
class Strip:
    """A picture over the mission's time."""

    title: str
    source: str  # the picture itself, as a data address


@dataclass(frozen=True)
class Table:
    """What was found."""

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    empty: str  # said instead of a table without rows


@dataclass(frozen=True)
class PageContent:
    """What differs between missions."""

    title: str
    result: Result
    figures: Sequence[tuple[str, str]]  # headings and values, that come first
    video: Video | None
    maps: Sequence[MapPanel]
    plots: Sequence[Plot]
    strips: Sequence[Strip]
    table: Table
    track: Sequence[Point]
    changes: Sequence[StateChange]
    place_digits: int  # of the places where states change


def page_of(content: PageContent) -> str:
    """The page as HTML; the video is a file beside it."""
    track = content.track
    duration = max(track[-1].time, 1e-9) if track else 1e-9
    spans: list[Span] = spans_of(content.changes, duration)
    return render(
        "rover_tools.report", "mission.html.j2",
        content=content, reason=content.result.get("reason"), spans=spans,
        seconds=seconds_by_state(spans), ticks=time_ticks(duration), rows=_rows(content.result),
        cursor=_cursor(track),
    )  # fmt: skip


def map_file(drawing: Drawing, style: str = "") -> str:
    """A drawing as an SVG file."""
    return render("rover_tools.report", "map_file.svg.j2", drawing=drawing, style=style)


def figures_of(result: Result, wanted: Sequence[tuple[str, str, str]]) -> list[tuple[str, str]]:
    """Of (heading, key, unit), the headings and values of those that are known.

    A key `collected/total` is shown as `5 of 6`.
    """
    figures = []
    for heading, key, unit in wanted:
        name, slash, total = key.partition("/")
        value = result.get(name)
        if value is None:
            continue
        shown = ("no", "yes")[value] if isinstance(value, bool) else f"{value:g}"
        of = f" of {result[total]}" if slash else ""
        figures.append((heading, f"{shown}{of} {unit}".strip()))
    return figures


def _rows(result: Result) -> list[tuple[str, str]]:
    """All of the result."""
    plain = ((key, value) for key, value in result.items() if not isinstance(value, list | dict))
    return [(key, "-" if value is None else str(value)) for key, value in plain]


def _cursor(track: Sequence[Point]) -> dict[str, Any]:
    """What the page shows of the moment under the pointer."""
    return {
        "time": [point.time for point in track],
        "x": [point.x for point in track],
        "y": [point.y for point in track],
        "state": [point.state for point in track],
    }
