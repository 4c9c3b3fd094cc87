"""Maps and tracks as paths of SVG, in metres with north at the top."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rover_common.map_encoding import EDGE, navigable_cells
from rover_common.types import GridMap, RockTrack
from rover_tools.report.mission_log import MissionLog, TrackPoint

MARGIN = 4.0  # [m] around what is drawn


@dataclass(frozen=True)
class Layer:
    """One path of a drawing."""

    kind: str  # its class in the style sheet
    path: str  # the attribute `d`


@dataclass(frozen=True)
class Window:
    """The part of the map frame that is drawn [m]; SVG's y is the negative of the map's."""

    x: float
    y: float  # of the north edge, negated
    width: float
    height: float

    @property
    def view_box(self) -> str:
        return f"{self.x:g} {self.y:g} {self.width:g} {self.height:g}"


@dataclass(frozen=True)
class MapDrawing:
    """Everything on a mission's maps."""

    window: Window
    known: tuple[Layer, ...]  # the map
    compared: tuple[Layer, ...]  # the map against the truth; empty without a truth
    track: tuple[Layer, ...]
    start: TrackPoint | None
    samples: tuple[tuple[float, float], ...]  # [m] true positions
    rocks: tuple[RockTrack, ...]


def drawing_of(log: MissionLog) -> MapDrawing:
    """Without a map, only the track."""
    grid, truth, samples = log.grid, log.truth.navigable, log.truth.samples
    return MapDrawing(
        window_of(log),
        () if grid is None else map_layers(grid),
        () if grid is None or truth is None else comparison_layers(grid, truth),
        track_layers(log.track),
        log.track[0] if log.track else None,
        () if samples is None else tuple((float(x), float(y)) for x, y in samples),
        log.rocks,
    )


def window_of(log: MissionLog) -> Window:
    """All known cells, all true ground and the whole track."""
    xy = [np.array([(point.x, point.y) for point in log.track]).reshape(-1, 2)]
    if log.grid is not None:
        known = log.grid.cells >= 0
        if log.truth.navigable is not None:
            known = known | log.truth.navigable
        rows, cols = np.nonzero(known)
        corners = np.column_stack([cols, rows])
        corner = (log.grid.origin_x, log.grid.origin_y)
        xy += [corner + corners * log.grid.resolution]
        xy += [corner + (corners + 1) * log.grid.resolution]
    places = np.concatenate(xy)
    if len(places) == 0:
        return Window(0.0, 0.0, 1.0, 1.0)
    low, high = places.min(axis=0) - MARGIN, places.max(axis=0) + MARGIN
    return Window(*np.round((low[0], -high[1], *(high - low)), 2).tolist())


def map_layers(grid: GridMap) -> tuple[Layer, ...]:
    """What the rover knows."""
    return (
        Layer("ground", cells_path(navigable_cells(grid.cells), grid)),
        Layer("obstacle", cells_path(grid.cells > EDGE, grid)),
    )


def comparison_layers(grid: GridMap, truth: NDArray[np.bool_]) -> tuple[Layer, ...]:
    """The map's navigable cells against the true ones, of the same shape."""
    navigable = navigable_cells(grid.cells)
    return (
        Layer("right", cells_path(navigable & truth, grid)),
        Layer("wrong", cells_path(navigable & ~truth, grid)),
        Layer("missing", cells_path(truth & ~navigable, grid)),
    )


def track_layers(track: Sequence[TrackPoint]) -> tuple[Layer, ...]:
    """The track in the colours of the states; each line goes on to the next state's first point."""
    lines: dict[str, list[str]] = {}
    for before, point in pairwise(track):
        parts = lines.setdefault(before.state, [])
        start, end = _at(before.x, before.y), _at(point.x, point.y)
        if not parts or parts[-1] != start:
            parts += [f"M{start}L", start]
        parts += [end]
    return tuple(Layer(state, " ".join(parts)) for state, parts in lines.items())


def cells_path(mask: NDArray[np.bool_], grid: GridMap) -> str:
    """The cells (rows, cols) of a mask, one rectangle for each run of cells in a row."""
    edges = np.diff(np.pad(mask.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    rows, starts = np.nonzero(edges == 1)
    _, ends = np.nonzero(edges == -1)
    size = grid.resolution
    return "".join(
        f"M{_at(grid.origin_x + start * size, grid.origin_y + (row + 1) * size)}"
        f"h{length * size:g}v{size:g}h{-length * size:g}z"
        for row, start, length in zip(
            rows.tolist(), starts.tolist(), (ends - starts).tolist(), strict=True
        )
    )


def _at(x: float, y: float) -> str:
    return f"{round(x, 2):g} {round(-y, 2):g}"
