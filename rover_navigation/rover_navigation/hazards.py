"""Places that a mission keeps its robot away from, whatever the map says."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry
from rover_common.map_encoding import FREE_BELOW
from rover_common.types import GridMap


class Hazards:
    """Blocked places in metres: they stay where they are when the map grows.

    They come as a grid of a map's kind: the map with blocked places in it, as Nav2's static layer
    takes it. What is occupied there and not on the robot's own map is a blocked place.
    """

    def __init__(self) -> None:
        self._centers = np.empty((2, 0))  # [m] x, y of their cells

    def set(self, hazards: GridMap, *own: GridMap) -> bool:
        """Replace all of them; own: the robot's maps without them. Whether something changed."""
        centers = np.stack(geometry_of(hazards).center_of(*np.nonzero(_occupied(hazards))))
        for grid in own:
            centers = centers[:, ~occupied_at(grid, *centers)]
        changed = not np.array_equal(centers, self._centers)
        self._centers = centers
        return changed

    def drawn_into(self, grid: GridMap) -> GridMap:
        """The map with the blocked places occupied; those beyond it are left out."""
        row, col = geometry_of(grid).cell_of(*self._centers)
        inside = geometry_of(grid).contains(row, col)
        if not inside.any():
            return grid
        cells = grid.cells.copy()
        cells[row[inside], col[inside]] = 100
        return GridMap(grid.resolution, grid.origin_x, grid.origin_y, cells)


def geometry_of(grid: GridMap) -> GridGeometry:
    """Which of a map's cells is where."""
    rows, cols = grid.cells.shape
    return GridGeometry(grid.resolution, rows, cols, grid.origin_x, grid.origin_y)


def occupied_at(grid: GridMap, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether points [m] lie in walls of a map; outside of it there are none."""
    row, col = geometry_of(grid).cell_of(x, y)
    wall = geometry_of(grid).contains(row, col)
    wall[wall] = _occupied(grid)[row[wall], col[wall]]
    return wall


def _occupied(grid: GridMap) -> NDArray[np.bool_]:
    return np.asarray(grid.cells >= FREE_BELOW)
