"""Layers of cells that grow with what they are given."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry
from rover_common.saved_state import Memory

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

    def memory(self) -> Callable[[], Memory]:
        """A copy; what is called makes a memory of it, of the cells that are not 0."""
        geometry, layers = self.geometry, self.layers.copy()

        def made() -> Memory:
            cells = np.flatnonzero(layers.any(axis=0))
            values = {
                "resolution": geometry.resolution,
                "shape": list(layers.shape),
                "origin": [geometry.origin_x, geometry.origin_y],
            }
            return values, {"cells": cells, "layers": layers.reshape(len(layers), -1)[:, cells]}

        return made

    def restore(self, memory: Memory) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        values, arrays = memory
        resolution, (count, rows, cols) = values["resolution"], values["shape"]
        if resolution != self.geometry.resolution or count != len(self.layers):
            raise ValueError(f"{count} layers of {resolution} m, not as these cells")
        x, y = values["origin"]
        layers = np.zeros((count, rows, cols))
        cells = arrays["cells"]
        if len(cells) and not 0 <= cells.min() <= cells.max() < layers[0].size:
            raise ValueError("cells beyond the grid")
        layers.reshape(len(layers), -1)[:, cells] = arrays["layers"]
        self.geometry = GridGeometry(resolution, rows, cols, float(x), float(y))
        self.layers = layers


def _growth(missing: int) -> int:
    """Cells to add where so many are missing."""
    return -(-missing // GROWTH) * GROWTH if missing > 0 else 0
