"""An occupancy grid that grows: log-odds of a wall in each cell."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry
from rover_common.map_encoding import EDGE, UNKNOWN
from rover_common.saved_state import Memory
from rover_common.types import GridMap
from rover_navigation.localization.growing_grid import GrowingGrid

# Sensor model, as log-odds: a ray that ends in a cell tells more than one that passes it, for the
# lidar's walls are thinner than a cell and a ray may pass beside them in the same cell.
HIT, PASS = 0.9, -0.4
LEAST, MOST = -2.0, 3.5  # so that a cell can change its mind within a few scans
BEHIND = 2  # [cells] behind a wall that are cleared with it
SAMPLES = 1.5  # per cell along a ray


class LogOddsMap:
    """What rays say of each cell, together."""

    def __init__(self, resolution: float) -> None:
        """resolution [m]"""
        self._grid = GrowingGrid(resolution, 2)  # log-odds; 1 where known

    @property
    def geometry(self) -> GridGeometry:
        """Where its cells are."""
        return self._grid.geometry

    def memory(self) -> Callable[[], Memory]:
        """As GrowingGrid.memory."""
        return self._grid.memory()

    def restore(self, memory: Memory) -> None:
        """As GrowingGrid.restore."""
        self._grid.restore(memory)

    def integrate(self, ends: NDArray[np.float64], origins: NDArray[np.float64]) -> None:
        """Rays (n, 2) [m] in the map frame, each from its origin to the wall at its end."""
        if len(ends) == 0:
            return
        self._grid.grow_to(np.concatenate([ends, origins]))
        log_odds, known = self._grid.layers
        hit, passed = np.zeros(known.shape, bool), np.zeros(known.shape, bool)
        hit[self.geometry.cell_of(ends[:, 0], ends[:, 1])] = True
        passed[self._cells_along(ends, origins)] = True
        passed |= _closed(passed) & (known == 0.0)
        passed |= self._just_behind(ends, origins) & self.walls
        passed &= ~hit
        log_odds[hit] += HIT
        log_odds[passed] += PASS
        np.clip(log_odds, LEAST, MOST, out=log_odds)
        known[hit | passed] = 1.0

    def _cells_along(
        self, ends: NDArray[np.float64], origins: NDArray[np.float64]
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Cells that the rays pass, up to one cell before their ends."""
        resolution = self.geometry.resolution
        rays = ends - origins
        lengths = np.hypot(rays[:, 0], rays[:, 1])
        away = np.arange(0.0, float(lengths.max()), resolution / SAMPLES)
        ray, step = np.nonzero(away < (lengths - resolution)[:, None])
        share = (away[step] / lengths[ray])[:, None]
        points = origins[ray] + share * rays[ray]
        return self.geometry.cell_of(points[:, 0], points[:, 1])

    def _just_behind(
        self, ends: NDArray[np.float64], origins: NDArray[np.float64]
    ) -> NDArray[np.bool_]:
        """(rows, cols) cells behind the ends. The walls are thin: what was hit there was this wall,
        from farther off, where the lidar's error is larger than a cell. No ray would clear it from
        this side, and scans that are matched to thick walls creep forward."""
        rays = ends - origins
        step = self.geometry.resolution * rays / np.hypot(rays[:, 0], rays[:, 1])[:, None]
        points = ends + np.arange(1, BEHIND + 1)[:, None, None] * step
        row, col = self.geometry.cell_of(points[:, :, 0], points[:, :, 1])
        inside = self.geometry.contains(row, col)
        behind = np.zeros(self.known.shape, bool)
        behind[row[inside], col[inside]] = True
        return behind

    @property
    def walls(self) -> NDArray[np.bool_]:
        """(rows, cols) cells that rather hold a wall than not."""
        return np.asarray(self._grid.layers[0] > 0.0)

    @property
    def known(self) -> NDArray[np.bool_]:
        """(rows, cols) cells that a ray has passed or hit."""
        return np.asarray(self._grid.layers[1] > 0.0)

    def grid(self) -> GridMap:
        """As nav_msgs/OccupancyGrid has it."""
        percent = np.rint(100.0 / (1.0 + np.exp(-self._grid.layers[0]))).astype(np.int8)
        percent[percent == EDGE] = EDGE - 1  # a value that means something else to a costmap
        cells = np.where(self.known, percent, np.int8(UNKNOWN))
        geometry = self.geometry
        return GridMap(geometry.resolution, geometry.origin_x, geometry.origin_y, cells)


def _closed(passed: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """With the single cells that lie between passed ones: far off, rays are sparser than cells."""
    square = np.ones((3, 3), np.uint8)
    return np.asarray(cv2.morphologyEx(passed.astype(np.uint8), cv2.MORPH_CLOSE, square) > 0)
