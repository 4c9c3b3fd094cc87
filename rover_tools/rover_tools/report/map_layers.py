"""Maps and tracks as paths of SVG, in metres with north at the top."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rover_common.map_encoding import EDGE, navigable_cells
from rover_common.types import GridMap
from rover_tools.report.track import Point


@dataclass(frozen=True)
class Layer:
    """One path of a drawing."""

    kind: str  # its class in the style sheet
    path: str  # the attribute `d`
    title: str = ""


@dataclass(frozen=True)
class Mark:
    """A symbol at a place."""

    kind: str  # its class in the style sheet
    shape: str  # circle or diamond
    x: float  # [m]
    y: float  # [m]
    size: float  # [m] radius, or half a side
    title: str


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
class Drawing:
    """Everything on one map of a mission."""

    window: Window
    cells: tuple[Layer, ...] = ()
    lines: tuple[Layer, ...] = ()  # above the cells
    track: tuple[Layer, ...] = ()
    start: tuple[float, float] | None = None  # [m]
    marks: tuple[Mark, ...] = ()  # above the track
    radius: float = 1.6  # [m] of what marks a place of the track
    transform: str = ""  # of all of it, into the window's frame


def window_around(places: NDArray[np.float64], margin: float) -> Window:
    """All places (n, 2) [m] with a margin [m] around them."""
    if len(places) == 0:
        return Window(0.0, 0.0, 1.0, 1.0)
    low, high = places.min(axis=0) - margin, places.max(axis=0) + margin
    return Window(*np.round((low[0], -high[1], *(high - low)), 2).tolist())


def map_layers(grid: GridMap) -> tuple[Layer, ...]:
    """What a map knows."""
    return (
        Layer("ground", cells_path(navigable_cells(grid.cells), grid)),
        Layer("obstacle", cells_path(grid.cells > EDGE, grid)),
    )


def track_layers(track: Sequence[Point], digits: int = 2) -> tuple[Layer, ...]:
    """The track in the colours of the states; each line goes on to the next state's first point.

    digits: of its places [m].
    """
    lines: dict[str, list[str]] = {}
    for before, point in pairwise(track):
        parts = lines.setdefault(before.state, [])
        start, end = _at(before.x, before.y, digits), _at(point.x, point.y, digits)
        if not parts or parts[-1] != start:
            parts += [f"M{start}L", start]
        parts += [end]
    return tuple(Layer(state, " ".join(parts), state) for state, parts in lines.items())


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


def _at(x: float, y: float, digits: int = 2) -> str:
    return f"{round(x, digits):g} {round(-y, digits):g}"
