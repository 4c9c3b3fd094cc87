"""The report of the rover's mission."""

from __future__ import annotations

import math

import numpy as np

from rover_common.types import RockTrack
from rover_tools.report.mission_log import MissionLog
from rover_tools.report.page_content import (
    Key,
    MapPanel,
    PageContent,
    Table,
    figures_of,
    map_file,
    page_of,
)
from rover_tools.report.plots import plots_of
from rover_tools.report.rover_drawing import comparison_of, drawing_of
from rover_tools.report.video.snapshot import Video

# Figures of the result that come first; heading, key, unit.
FIGURES = (
    ("time", "time", "s"),
    ("samples", "samples_collected/samples_total", ""),
    ("mapped", "percent_mapped", "%"),
    ("fidelity", "fidelity", "%"),
    ("distance home", "home_distance", "m"),
    ("driven", "distance", "m"),
    ("contacts", "contacts", ""),
    ("recoveries", "recoveries", ""),
    ("oracle's time", "oracle_time", "s"),
)
COMPARED = (
    Key("navigable, rightly", "green"),
    Key("navigable, wrongly", "vermillion"),
    Key("not mapped", "yellow"),
)


def mission_page(log: MissionLog, video: Video | None = None) -> str:
    """The page as HTML; the video is a file beside it."""
    return page_of(
        PageContent(
            title=log.title,
            result=log.result,
            figures=figures_of(log.result, FIGURES),
            video=video,
            maps=_maps(log),
            plots=plots_of(log.track),
            strips=(),
            table=_rocks(log),
            track=log.track,
            changes=log.changes,
            place_digits=0,
        )
    )


def mission_map(log: MissionLog) -> str:
    """The map against the truth, or the map where there is none, as an SVG file."""
    compared = comparison_of(log)
    return map_file(compared or drawing_of(log), "compared" if compared else "")


def _maps(log: MissionLog) -> list[MapPanel]:
    if log.grid is None:
        return []
    legend = [Key("rock on the map", "yellow")]
    if _has_samples(log):
        legend.append(Key("○ true sample"))
    title = "Map, with the track by state"
    panels = [MapPanel(title, drawing_of(log), tuple(legend), states=True)]
    compared = comparison_of(log)
    if compared is not None:
        panels.append(MapPanel("Map against the truth", compared, COMPARED, "compared"))
    return panels


def _rocks(log: MissionLog) -> Table:
    headings: tuple[str, ...] = ("x, y [m]", "deviation [m]", "observations")
    if _has_samples(log):
        headings += ("error [m]",)
    rows = tuple(_rock_row(rock, log) for rock in log.rocks)
    return Table("Rocks", headings, rows, "No rock on the map.")


def _rock_row(rock: RockTrack, log: MissionLog) -> tuple[str, ...]:
    """Place, standard deviation along the longer axis, and distance to the nearest true sample."""
    largest = float(np.linalg.eigvalsh(np.reshape(rock.covariance, (2, 2)))[-1])
    deviation = math.sqrt(max(0.0, largest))
    row = (f"{rock.x:.1f}, {rock.y:.1f}", f"{deviation:.2f}", str(rock.observations))
    if not _has_samples(log):
        return row
    assert log.truth.samples is not None
    error = float(np.hypot(*(log.truth.samples - (rock.x, rock.y)).T).min())
    return (*row, f"{error:.2f}")


def _has_samples(log: MissionLog) -> bool:
    return log.truth.samples is not None and len(log.truth.samples) > 0
