"""Layers of cells that grow with what they are given."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry

GROWTH = 20  # [cells] at once


class GrowingGrid:
    """Cells lie on multiples of the resolution in the map frame; new ones are 0 in all layers."""

    def __init__(self, resolution: float, layers: int) -> None:
        """resolution [m]"""
        self.geometry = GridGeometry(resolution, 0, 0)
        self.layers: NDArray[np.float64] = np.zeros((layers, 0, 0))  # (layers, rows, cols)

    def grow_to(self, points: NDArray[np.float64]) -> None:
        """Make all points (n, 2) [m] lie inside; at least one."""
        old = self.geometry
        if old.rows == 0:
            row, col = (int(i) for i in old.cell_of(*points[0]))
            x, y = (i * old.resolution for i in (col, row))
            old = GridGeometry(old.resolution, 0, 0, x, y)
        rows, cols = old.cell_of(points[:, 0], points[:, 1])
        down, up = _growth(-int(rows.min())), _growth(int(rows.max()) + 1 - old.rows)
        left, right = _growth(-int(cols.min())), _growth(int(cols.max()) + 1 - old.cols)
        self.geometry = GridGeometry(
            old.resolution,
            old.rows + down + up,
            old.cols + left + right,
            old.origin_x - left * old.resolution,
            old.origin_y - down * old.resolution,
        )
        if (down, up, left, right) != (0, 0, 0, 0):
            self.layers = np.pad(self.layers, ((0, 0), (down, up), (left, right)))


def _growth(missing: int) -> int:
    """Cells to add where so many are missing."""
    return -(-missing // GROWTH) * GROWTH if missing > 0 else 0
