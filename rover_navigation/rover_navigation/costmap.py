"""The navigation map as the planner needs it: what is free, what is unknown, how far walls are."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry
from rover_common.map_encoding import EDGE, FREE_BELOW
from rover_common.types import GridMap

MARGIN = 12  # [cells] kept around what is known
TRAIL_RADIUS = 0.5  # [m] around where the rover has been: free when unknown, it was there
# [m] the same, free whatever the map says; no more, because its wheels pass rocks 0.44 m aside
UNDER_BODY = 0.25
# [m] Unknown ground this near to an obstacle is kept away from like one: mostly it is the far side
# of the rock, or the wall around the corner. An edge there is only driven by with care: where a
# passage is narrow, edges seen from afar would close it.
HIDDEN_SIDE = 1.0
BODY_RADIUS = 1.2  # [m] around the rover, where its camera cannot see: taken as free when unknown


@dataclass(frozen=True)
class Blocked:
    """A place that proved impassable."""

    x: float  # [m] map frame
    y: float  # [m]
    radius: float  # [m]
    until: float = math.inf  # [s] frame time


@dataclass(frozen=True)
class Costmap:
    """A part of the navigation map; all arrays (rows, cols), an even number of each."""

    geometry: GridGeometry
    free: NDArray[np.bool_]
    unknown: NDArray[np.bool_]  # edges seen from afar as well
    edge: NDArray[np.bool_]
    # [m] from a cell's centre to the edge of the nearest obstacle, or of what it may hide
    clearance: NDArray[np.float32]
    room: NDArray[np.float32]  # [m] the same, and to the edges beside obstacles

    @classmethod
    def of(
        cls,
        grid: GridMap,
        trail: NDArray[np.float64],
        body: tuple[float, float],
        blocked: tuple[Blocked, ...] = (),
    ) -> Costmap:
        """`trail` (n, 2) [m]: where the rover has been; `body` [m]: where it stands."""
        geometry, cells = _crop(grid, body)
        edge = cells == EDGE
        obstacle = (cells >= FREE_BELOW) & ~edge
        unknown = (cells < 0) | edge
        been = _discs(geometry, trail, TRAIL_RADIUS)
        here = _discs(geometry, np.array([body]), BODY_RADIUS) & unknown
        obstacle &= ~_discs(geometry, trail, UNDER_BODY)
        unknown &= ~(been | here)
        for place in blocked:
            disc = _discs(geometry, np.array([[place.x, place.y]]), place.radius)
            obstacle |= disc
            unknown &= ~disc
        beside = _grown(obstacle, HIDDEN_SIDE / geometry.resolution) & unknown
        return cls(
            geometry,
            ~obstacle & ~unknown,
            unknown,
            edge & unknown,
            clearance=_distance(obstacle | (beside & ~edge), geometry.resolution),
            room=_distance(obstacle | beside, geometry.resolution),
        )


def _crop(grid: GridMap, body: tuple[float, float]) -> tuple[GridGeometry, NDArray[np.int8]]:
    """The known part of the map with a margin."""
    whole = _geometry(grid.resolution, grid.cells.shape, grid.origin_x, grid.origin_y)
    known = grid.cells >= 0
    row, col = (int(i) for i in whole.cell_of(*body))
    bounds = []
    for axis, at in ((1, row), (0, col)):
        indices = np.flatnonzero(known.any(axis=axis))
        first, last = (indices[0], indices[-1]) if len(indices) else (at, at)
        size = grid.cells.shape[1 - axis]
        low = max(0, min(int(first), at) - MARGIN) // 2 * 2
        high = min(size, (max(int(last), at) + MARGIN + 1) // 2 * 2)
        bounds.append((low, high))
    (row0, row1), (col0, col1) = bounds
    cells = grid.cells[row0:row1, col0:col1]
    x, y = (grid.origin_x + col0 * grid.resolution, grid.origin_y + row0 * grid.resolution)
    return _geometry(grid.resolution, cells.shape, x, y), cells


def _geometry(resolution: float, shape: tuple[int, ...], x: float, y: float) -> GridGeometry:
    rows, cols = shape
    return GridGeometry(resolution, rows, cols, x, y)


def _distance(mask: NDArray[np.bool_], resolution: float) -> NDArray[np.float32]:
    """[m] from each cell's centre to the edge of the nearest true cell."""
    cells = cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 5)
    return np.maximum(0.0, np.asarray(cells, np.float32) * resolution - resolution / 2)


def _grown(mask: NDArray[np.bool_], cells: float) -> NDArray[np.bool_]:
    """The mask with all that lies within so many cells of it."""
    size = 2 * round(cells) + 1
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
    return np.asarray(cv2.dilate(mask.astype(np.uint8), disc) > 0)


def _discs(geometry: GridGeometry, points: NDArray[np.float64], radius: float) -> NDArray[np.bool_]:
    """Cells within a radius [m] of any of the points (n, 2) [m]."""
    mask = np.zeros((geometry.rows, geometry.cols), np.uint8)
    rows, cols = geometry.cell_of(points[:, 0], points[:, 1])
    for row, col in zip(rows.tolist(), cols.tolist(), strict=True):
        cv2.circle(mask, (col, row), round(radius / geometry.resolution), 1, -1)
    return mask.astype(bool)
