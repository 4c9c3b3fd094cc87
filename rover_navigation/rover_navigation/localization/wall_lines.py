"""The line that the walls around each cell of a map form, finer than the cells.

Each cell sums up the points that hit it, the nearer ones with more weight. A square of three by
three cells gives the middle of its points and their principal directions, as in the normal
distributions transform (Biber and Strasser, 2003); the shorter one is the wall's normal.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry
from rover_common.saved_state import Memory
from rover_navigation.localization.growing_grid import GrowingGrid

SIGMA = 0.02  # [m] of a point from its wall's line, beside the lidar's error: the pose's, and more
LIDAR_SIGMA, LIDAR_SHARE = 0.005, 0.01  # [m], and of the range
WEIGHT_LEAST = 0.8  # of all points around a cell, where a near one counts as 1
LENGTH_LEAST = 0.02  # [m] deviation along the line; a heap has no direction


def variance(ranges: NDArray[np.float64]) -> NDArray[np.float64]:
    """[m^2] of a point's distance from its wall's line, by its range [m]."""
    return SIGMA**2 + np.square(LIDAR_SIGMA + LIDAR_SHARE * ranges)


@dataclass(frozen=True)
class LineField:
    """One line in each cell; arrays (rows, cols)."""

    geometry: GridGeometry
    x: NDArray[np.float64]  # [m] of its middle
    y: NDArray[np.float64]  # [m]
    normal_x: NDArray[np.float64]
    normal_y: NDArray[np.float64]
    weight: NDArray[np.float64]  # 0..1: whether there is a line

    def residuals(
        self, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Of points (n, 2) [m]: distances (n,) [m] from the lines, normals (n, 2), weights (n,)."""
        row, col = self.geometry.nearest_cell_to(points[:, 0], points[:, 1])
        normal = np.stack([self.normal_x[row, col], self.normal_y[row, col]], axis=1)
        away_x, away_y = points[:, 0] - self.x[row, col], points[:, 1] - self.y[row, col]
        distance = normal[:, 0] * away_x + normal[:, 1] * away_y
        return distance, normal, self.weight[row, col]


class WallLines:
    """The sums, to which points are added."""

    def __init__(self, resolution: float) -> None:
        """resolution [m]"""
        self._grid = GrowingGrid(resolution, 6)  # weights, and weighted x, y, xx, xy, yy

    def memory(self) -> Callable[[], Memory]:
        """As GrowingGrid.memory."""
        return self._grid.memory()

    def restore(self, memory: Memory) -> None:
        """As GrowingGrid.restore."""
        self._grid.restore(memory)

    def add(self, points: NDArray[np.float64], ranges: NDArray[np.float64]) -> None:
        """Points (n, 2) [m] in the map frame, and their ranges (n,) [m]."""
        grid = self._grid
        grid.grow_to(points)
        x, y = points.T
        weight = SIGMA**2 / variance(ranges)
        row, col = grid.geometry.cell_of(x, y)
        cell = row * grid.geometry.cols + col
        count = grid.layers[0].size
        for layer, factor in zip(grid.layers, (1.0, x, y, x * x, x * y, y * y), strict=True):
            layer += np.bincount(cell, weight * factor, count).reshape(layer.shape)

    def field(self) -> LineField:
        """The lines now."""
        total, *sums = (cv2.boxFilter(a, -1, (3, 3), normalize=False) for a in self._grid.layers)
        x, y, xx, xy, yy = (np.asarray(a) / np.maximum(total, 1e-9) for a in sums)
        xx, xy, yy = xx - x * x, xy - x * y, yy - y * y
        spread, difference = xx + yy, np.hypot(xx - yy, 2.0 * xy)
        along, across = (spread + difference) / 2.0, np.maximum((spread - difference) / 2.0, 0.0)
        angle = 0.5 * np.arctan2(2.0 * xy, xx - yy)
        is_line = (total > WEIGHT_LEAST) & (along > LENGTH_LEAST**2)
        weight = np.where(is_line, np.square(1.0 - across / np.maximum(along, 1e-9)), 0.0)
        return LineField(self._grid.geometry, x, y, -np.sin(angle), np.cos(angle), weight)
