"""The navigation map as the planner needs it: what is free, what is unknown, the clearance."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry
from rover_common.map_encoding import EDGE, FREE_BELOW
from rover_common.types import GridMap
from rover_navigation.scale import Scale
from rover_navigation.types import BlockedPlace

MARGIN = 12  # [cells] kept around what is known


@dataclass(frozen=True)
class Costmap:
    """A part of the navigation map; all arrays (rows, cols), an even number of each."""

    geometry: GridGeometry
    free: NDArray[np.bool_]
    unknown: NDArray[np.bool_]  # edges seen from afar as well
    edge: NDArray[np.bool_]
    # [m] from a cell's centre to the border of the nearest obstacle, or of what it may hide
    clearance: NDArray[np.float32]
    # [m] the same, to edges beside obstacles as well. Those are only driven by with care: where a
    # passage is narrow, edges seen from afar would close it.
    edge_clearance: NDArray[np.float32]

    @classmethod
    def of(
        cls,
        grid: GridMap,
        trail: NDArray[np.float64],
        body: tuple[float, float],
        scale: Scale,
        blocked: tuple[BlockedPlace, ...] = (),
    ) -> Costmap:
        """`trail` (n, 2) [m]: where the robot has been; `body` [m]: where it stands."""
        geometry, cells = _crop(grid, body)
        edge = cells == EDGE
        obstacle = (cells >= FREE_BELOW) & ~edge
        unknown = (cells < 0) | edge
        been = _discs(geometry, trail, scale.trail_radius)
        here = _discs(geometry, np.array([body]), scale.blind_radius) & unknown
        obstacle &= ~_discs(geometry, trail, scale.under_body_radius)
        unknown &= ~(been | here)
        for place in blocked:
            disc = _discs(geometry, np.array([[place.x, place.y]]), place.radius)
            obstacle |= disc
            unknown &= ~disc
        beside = _grown(obstacle, scale.hidden_side / geometry.resolution) & unknown
        return cls(
            geometry,
            ~obstacle & ~unknown,
            unknown,
            edge & unknown,
            clearance=_distance(obstacle | (beside & ~edge), geometry.resolution),
            edge_clearance=_distance(obstacle | beside, geometry.resolution),
        )


def _crop(grid: GridMap, body: tuple[float, float]) -> tuple[GridGeometry, NDArray[np.int8]]:
    """The known part of the map and the body, with a margin; never empty."""
    whole = _geometry(grid.resolution, grid.cells.shape, grid.origin_x, grid.origin_y)
    known = grid.cells >= 0
    row, col = (int(i) for i in whole.nearest_cell_to(*body))
    bounds = []
    for axis, at in ((1, row), (0, col)):
        indices = np.flatnonzero(known.any(axis=axis))
        first, last = (indices[0], indices[-1]) if len(indices) else (at, at)
        size = grid.cells.shape[1 - axis] // 2 * 2  # the last cell of an odd number is left out
        low = min(size - 2, max(0, min(int(first), at) - MARGIN) // 2 * 2)
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
    """[m] from each cell's centre to the border of the nearest true cell."""
    cells = cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 5)
    return np.maximum(0.0, np.asarray(cells, np.float32) * resolution - resolution / 2)


def _grown(mask: NDArray[np.bool_], cells: float) -> NDArray[np.bool_]:
    """The mask with all that lies within so many cells of it."""
    size = 2 * round(cells) + 1
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
    return np.asarray(cv2.dilate(mask.astype(np.uint8), disc) > 0)


def _discs(geometry: GridGeometry, points: NDArray[np.float64], radius: float) -> NDArray[np.bool_]:
    """Cells within a radius [m] of any of the points (n, 2) [m], which may lie outside."""
    mask = np.zeros((geometry.rows, geometry.cols), bool)
    cells = np.stack(geometry.cell_of(points[:, 0], points[:, 1]))
    disc = _disc(round(radius / geometry.resolution))
    # Of a trail, each cell once: a robot that comes back costs nothing more.
    rows, cols = (np.unique(cells, axis=1)[:, :, None] + disc[:, None]).reshape(2, -1)
    inside = geometry.contains(rows, cols)
    mask[rows[inside], cols[inside]] = True
    return mask


@cache
def _disc(radius: int) -> NDArray[np.intp]:
    """Rows and columns (2, n) of a disc of so many cells, from its middle."""
    picture = np.zeros((2 * radius + 1, 2 * radius + 1), np.uint8)
    cv2.circle(picture, (radius, radius), radius, 1, -1)
    return np.stack(np.nonzero(picture)) - radius
