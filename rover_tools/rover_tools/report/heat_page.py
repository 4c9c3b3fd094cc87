"""The report of a heat mission."""

from __future__ import annotations

import base64
import math

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import compose_points
from rover_heat.thermal.picture import WARM, coloured
from rover_heat.types import HeatSource
from rover_tools.report.heat_drawing import map_drawing, maze_drawing
from rover_tools.report.heat_log import HeatLog, HeatTrackPoint
from rover_tools.report.page_content import (
    Key,
    MapPanel,
    PageContent,
    Strip,
    Table,
    figures_of,
    map_file,
    page_of,
)
from rover_tools.report.plots import Plot, plot_of
from rover_tools.report.video.snapshot import Video

# Figures of the result that come first; heading, key, unit.
FIGURES = (
    ("success", "success", ""),
    ("time", "time", "s"),
    ("sources", "sources_found/sources_total", ""),
    ("false sources", "sources_false", ""),
    ("delivered", "delivered/sources_total", ""),
    ("ramp done", "ramp_done", ""),
    ("contacts", "contacts", ""),
    ("interrupts", "interrupts", ""),
    ("pose error", "pose_rmse", "m"),
    ("driven", "distance", "m"),
)
KNOWN = (
    Key("source found", "green"),
    Key("source served", "blue"),
    Key("◇ payload released"),
    Key("kept away from", "purple"),
)
TRUE = (
    Key("true heat source", "vermillion"),
    Key("wall examined for heat", "green"),
    Key("not examined", "orange"),
    Key("ramp", "yellow"),
)


def heat_page(log: HeatLog, video: Video | None = None) -> str:
    """The page as HTML; the video is a file beside it."""
    return page_of(
        PageContent(
            title=log.title,
            result=log.result,
            figures=figures_of(log.result, FIGURES),
            video=video,
            maps=_maps(log),
            plots=heat_plots(log.track),
            strips=_strips(log),
            table=_sources(log),
            track=log.track,
            changes=log.changes,
            place_digits=2,
        )
    )


def heat_map(log: HeatLog) -> str:
    """The map with all that was found, as an SVG file."""
    return map_file(map_drawing(log))


def heat_maze(log: HeatLog) -> str | None:
    """The true maze with what was examined, as an SVG file; None where it is not known."""
    drawing = maze_drawing(log)
    return None if drawing is None else map_file(drawing, "maze")


def heat_plots(track: tuple[HeatTrackPoint, ...]) -> list[Plot]:
    """None without a track."""
    if not track:
        return []
    times = [point.time for point in track]
    plots = [
        plot_of("Speed [m/s]", 2, times, {"speed": [p.speed for p in track]}, 0.2),
        plot_of("Largest tilt [°]", 1, times, {"tilt": [math.degrees(p.tilt) for p in track]}),
        plot_of("Explored, as the mission estimates [%]", 1, times,
                {"explored": [p.explored for p in track]}, 100.0),
        plot_of("Sources known, served", 0, times,
                {"known": [float(p.sources_known) for p in track],
                 "served": [float(p.sources_delivered) for p in track]}),
        plot_of("Warmest pixel over the median, sensors 1 and 2 [K]", 1, times,
                {"sensor-1": [p.excess_1 for p in track], "sensor-2": [p.excess_2 for p in track]}),
    ]  # fmt: skip
    if any(point.position_error is not None for point in track):
        errors = [None if p.position_error is None else 100.0 * p.position_error for p in track]
        plots.append(plot_of("Error of the position [cm]", 1, times, {"error": errors}))
    return plots


def thermal_strip(excess: NDArray[np.float64]) -> NDArray[np.uint8]:
    """(8, n, 3) RGB: of each point (n, 8) [K], the sensor's left column on top."""
    return coloured(excess.T)


def _maps(log: HeatLog) -> list[MapPanel]:
    title = "Map, with the track by state"
    panels = [MapPanel(title, map_drawing(log), KNOWN, states=True)]
    drawing = maze_drawing(log)
    if drawing is not None:
        panels.append(MapPanel("The true maze, and what was examined", drawing, TRUE, "maze"))
    return panels


def _strips(log: HeatLog) -> list[Strip]:
    strips = []
    for sensor in (1, 2):
        excess = log.excess[:, sensor - 1]
        if not np.isfinite(excess).any():
            continue
        _, data = cv2.imencode(".png", cv2.cvtColor(thermal_strip(excess), cv2.COLOR_RGB2BGR))
        source = "data:image/png;base64," + base64.b64encode(data.tobytes()).decode()
        title = f"Thermal sensor {sensor}: its columns from left (top) to right, 0 to {WARM:g} K"
        strips.append(Strip(title, source))
    return strips


def _sources(log: HeatLog) -> Table:
    headings: tuple[str, ...] = (
        "source",
        "x, y [m]",
        "deviation [m]",
        "fixes",
        "peak [K]",
        "served",
    )
    if log.maze is not None:
        headings += ("error [m]",)
    rows = tuple(_source_row(source, log) for source in log.overlay.sources)
    return Table("Heat sources", headings, rows, "No heat source was found.")


def _source_row(source: HeatSource, log: HeatLog) -> tuple[str, ...]:
    largest = float(np.linalg.eigvalsh(np.reshape(source.covariance, (2, 2)))[-1])
    row = (
        str(source.id), f"{source.x:.2f}, {source.y:.2f}", f"{math.sqrt(max(0.0, largest)):.3f}",
        str(source.observations), f"{source.peak:.1f}", "yes" if source.delivered else "no",
    )  # fmt: skip
    if log.maze is None:
        return row
    placed = compose_points(log.map_in_world, np.array([(source.x, source.y)]))
    true = np.array([(each.x, each.y) for each in log.maze.sources]).reshape(-1, 2)
    error = float(np.hypot(*(true - placed).T).min(initial=math.inf))
    return (*row, f"{error:.3f}" if math.isfinite(error) else "-")
