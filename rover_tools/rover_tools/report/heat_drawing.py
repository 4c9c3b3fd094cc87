"""The maps of a heat mission: what it knows, and the true maze with what it has examined.

Both are drawn in the map frame and then turned into the maze's, where there is one.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from burger_simulator.world.maze import HeatSource as TrueSource
from burger_simulator.world.maze import Maze, Ramp
from rover_common.geometry import Pose, compose_points, inverse
from rover_heat.types import HeatSource
from rover_tools.report.heat_log import HeatLog
from rover_tools.report.map_layers import (
    Drawing,
    Layer,
    Mark,
    Window,
    map_layers,
    track_layers,
    window_around,
)

MARGIN = 0.12  # [m] around what is drawn
RADIUS = 0.035  # [m] of what marks a place of the track
SOURCE, LAUNCH = 0.06, 0.03  # [m]
PATCH = 2.0  # [sigma] of a warm patch that are drawn

Points = NDArray[np.float64]  # (n, 2) [m]


def map_drawing(log: HeatLog) -> Drawing:
    """What the mission knows at its end, with its track by state."""
    hazards = log.overlay.hazards
    strips = [
        Layer("hazard", outline(strip.corners()), "kept away from") for strip in hazards.strips
    ]
    discs = [Layer("hazard", outline(disc_of(d.x, d.y, d.radius))) for d in hazards.discs]
    return Drawing(
        window_of(log),
        cells=() if log.grid is None else map_layers(log.grid),
        lines=(*strips, *discs),
        track=track_layers(log.track, digits=3),
        marks=(*_launches(log), *_found(log.overlay.sources)),
        **_common(log),
    )


def maze_drawing(log: HeatLog) -> Drawing | None:
    """The true maze, with the map's walls and the faces that were examined; None without one."""
    if log.maze is None:
        return None
    overlay = log.overlay
    faces = [
        Layer("face", dots(overlay.faces), "examined"),
        Layer("open-face", dots(overlay.open_faces), "not examined"),
    ]
    return Drawing(
        window_of(log),
        cells=() if log.grid is None else map_layers(log.grid)[1:],
        lines=(*_maze_lines(log, log.maze), *faces),
        track=track_layers(log.track, digits=3),
        marks=_found(overlay.sources),
        **_common(log),
    )


def window_of(log: HeatLog) -> Window:
    """The maze where there is one, else all known cells and the whole track."""
    if log.maze is not None:
        return window_around(np.array([(0.0, 0.0), (log.maze.width, log.maze.height)]), MARGIN)
    places = [np.array([(point.x, point.y) for point in log.track]).reshape(-1, 2)]
    if log.grid is not None:
        rows, cols = np.nonzero(log.grid.cells >= 0)
        corner = (log.grid.origin_x, log.grid.origin_y)
        places.append(corner + np.column_stack([cols, rows]) * log.grid.resolution)
    return window_around(np.concatenate(places), MARGIN)


def ramp_parts(ramp: Ramp) -> list[Points]:
    """The corners of ascent, flat part and descent."""
    top, end = ramp.slope_length, ramp.slope_length + ramp.flat_length
    return [_on_ramp(ramp, *span) for span in ((0.0, top), (top, end), (end, ramp.length))]


def patch_of(source: TrueSource) -> Points:
    """Half a disc on the warm side of its wall."""
    angles = source.normal + np.linspace(-math.pi / 2, math.pi / 2, 17)
    aside = PATCH * source.sigma * np.column_stack([np.cos(angles), np.sin(angles)])
    return aside + np.array([source.x, source.y])


def disc_of(x: float, y: float, radius: float) -> Points:
    angles = np.linspace(0.0, 2.0 * math.pi, 33)[:-1]
    return radius * np.column_stack([np.cos(angles), np.sin(angles)]) + np.array([x, y])


def outline(points: Points) -> str:
    """A polygon as a path."""
    return "M" + "L".join(f"{x:.3f} {-y:.3f}" for x, y in points) + "z"


def dots(points: Points) -> str:
    """Each point as a line without length, which a round cap makes a dot."""
    return "".join(f"M{x:.3f} {-y:.3f}h0" for x, y in points)


def _common(log: HeatLog) -> dict:
    frame = log.map_in_world
    turned = f"translate({frame.x:.4f} {-frame.y:.4f}) rotate({-math.degrees(frame.yaw):.3f})"
    return {
        "start": (log.track[0].x, log.track[0].y) if log.track else None,
        "radius": RADIUS,
        "transform": "" if log.maze is None else turned,
    }


def _maze_lines(log: HeatLog, maze: Maze) -> Iterable[Layer]:
    to_map = inverse(log.map_in_world)

    def path(points: Points) -> str:
        return outline(compose_points(to_map, points))

    if maze.ramp is not None:
        up, flat, down = map(path, ramp_parts(maze.ramp))
        yield from (Layer("ramp", up, "ramp"), Layer("flat", flat), Layer("ramp", down))
    for source in maze.sources:
        yield Layer("patch", path(patch_of(source)), "true heat source")
    ends = np.array([[(wall.x0, wall.y0), (wall.x1, wall.y1)] for wall in maze.walls])
    in_map = compose_points(to_map, ends.reshape(-1, 2)).reshape(-1, 2, 2)
    lines = [f"M{a[0]:.3f} {-a[1]:.3f}L{b[0]:.3f} {-b[1]:.3f}" for a, b in in_map]
    yield Layer("wall", "".join(lines))


def _found(sources: Iterable[HeatSource]) -> tuple[Mark, ...]:
    return tuple(
        Mark(
            "found delivered" if source.delivered else "found", "circle", round(source.x, 3),
            round(source.y, 3), SOURCE, f"source {source.id}, {source.observations} fixes",
        )
        for source in sources
    )  # fmt: skip


def _launches(log: HeatLog) -> tuple[Mark, ...]:
    if log.maze is None:
        return ()
    places = np.array([(each.pose.x, each.pose.y) for each in log.launches]).reshape(-1, 2)
    in_map = compose_points(inverse(log.map_in_world), places).round(3).tolist()
    return tuple(Mark("launch", "diamond", x, y, LAUNCH, "payload released") for x, y in in_map)


def _on_ramp(ramp: Ramp, first: float, last: float) -> Points:
    """The corners of its part between two distances [m] from its foot line."""
    side = ramp.width / 2
    corners = np.array([(first, -side), (last, -side), (last, side), (first, side)])
    return compose_points(Pose(ramp.x, ramp.y, ramp.yaw), corners)
