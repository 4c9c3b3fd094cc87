"""The report of one mission: one HTML file, which a browser shows without a network."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rover_common.types import RockTrack
from rover_tools.report.map_layers import drawing_of
from rover_tools.report.mission_log import MissionLog
from rover_tools.report.pages import render
from rover_tools.report.plots import plots_of, seconds_by_state, spans_of, time_ticks
from rover_tools.report.video.snapshot import Video

# Figures of the result that come first; heading, key, unit.
FIGURES = (
    ("time", "time", "s"),
    ("samples", "samples_collected", ""),
    ("mapped", "percent_mapped", "%"),
    ("fidelity", "fidelity", "%"),
    ("distance home", "home_distance", "m"),
    ("driven", "distance", "m"),
    ("contacts", "contacts", ""),
    ("recoveries", "recoveries", ""),
    ("oracle's time", "oracle_time", "s"),
)


@dataclass(frozen=True)
class RockRow:
    """A rock on the map."""

    x: float  # [m]
    y: float  # [m]
    deviation: float  # [m] standard, along the longer axis
    observations: int
    error: float | None  # [m] to the nearest true sample


def mission_page(log: MissionLog, video: Video | None = None) -> str:
    """The page as HTML; the video is a file beside it."""
    duration = max(log.track[-1].time, 1e-9) if log.track else 1e-9
    spans = spans_of(log.changes, duration)
    plots = plots_of(log.track)
    return render(
        "rover_tools.report", "mission.html.j2",
        title=log.title, reason=log.result.get("reason"), figures=_figures(log), video=video,
        drawing=drawing_of(log), rocks=[_rock_row(rock, log) for rock in log.rocks],
        spans=spans, seconds=seconds_by_state(spans), plots=plots, ticks=time_ticks(duration),
        changes=log.changes, rows=_rows(log), cursor=_cursor(log),
    )  # fmt: skip


def mission_map(log: MissionLog) -> str:
    """The map against the truth, or the map where there is none, as an SVG file."""
    return render("rover_tools.report", "map_file.svg.j2", drawing=drawing_of(log))


def _figures(log: MissionLog) -> list[tuple[str, str]]:
    """Headings and values, of those that are known."""
    result, figures = log.result, []
    for heading, key, unit in FIGURES:
        value = result.get(key)
        if value is None:
            continue
        total = f" of {result['samples_total']}" if key == "samples_collected" else ""
        figures.append((heading, f"{value:g}{total} {unit}".strip()))
    return figures


def _rock_row(rock: RockTrack, log: MissionLog) -> RockRow:
    largest = float(np.linalg.eigvalsh(np.reshape(rock.covariance, (2, 2)))[-1])
    samples = log.truth.samples
    error = None
    if samples is not None and len(samples):
        error = float(np.hypot(*(samples - (rock.x, rock.y)).T).min())
    return RockRow(rock.x, rock.y, math.sqrt(max(0.0, largest)), rock.observations, error)


def _rows(log: MissionLog) -> list[tuple[str, str]]:
    """All of the result."""
    plain = (
        (key, value) for key, value in log.result.items() if not isinstance(value, list | dict)
    )
    return [(key, "-" if value is None else str(value)) for key, value in plain]


def _cursor(log: MissionLog) -> dict[str, Any]:
    """What the page shows of the moment under the pointer."""
    return {
        "time": [point.time for point in log.track],
        "x": [point.x for point in log.track],
        "y": [point.y for point in log.track],
        "state": [point.state for point in log.track],
    }
