"""Regular grids over the world: which cell is where."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class WorldModel:
    """The simulator's world: a square whose south-west corner is the map frame's origin."""

    size: float  # [m] edge
    start_x: float  # [m] map frame, where the rover starts in the original canyon
    start_y: float  # [m]

    def contains(self, x: float, y: float) -> bool:
        """Whether a point [m] of the map frame lies in the world."""
        return 0.0 <= x < self.size and 0.0 <= y < self.size


WORLD = WorldModel(size=200.0, start_x=99.67, start_y=85.589)  # constants of the simulator


@dataclass(frozen=True)
class GridGeometry:
    """A grid of square cells; row grows with y, column with x; cell (0, 0) begins at the origin."""

    resolution: float  # [m]
    rows: int
    cols: int
    origin_x: float = 0.0  # [m] map frame
    origin_y: float = 0.0  # [m]

    @classmethod
    def of_world(cls, resolution: float) -> GridGeometry:
        """The grid that covers the simulator's world."""
        count = round(WORLD.size / resolution)
        return cls(resolution, count, count)

    def cell_of(self, x: ArrayLike, y: ArrayLike) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Row and column of the cells that hold the points (x, y) [m]; may lie outside."""
        col = np.floor((np.asarray(x) - self.origin_x) / self.resolution).astype(np.intp)
        row = np.floor((np.asarray(y) - self.origin_y) / self.resolution).astype(np.intp)
        return row, col

    def nearest_cell_to(
        self, x: ArrayLike, y: ArrayLike
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Row and column of the cells that hold the points [m], of the nearest ones outside."""
        row, col = self.cell_of(x, y)
        return np.clip(row, 0, self.rows - 1), np.clip(col, 0, self.cols - 1)

    def contains(self, row: ArrayLike, col: ArrayLike) -> NDArray[np.bool_]:
        """Whether each cell lies inside."""
        row, col = np.asarray(row), np.asarray(col)
        return (row >= 0) & (row < self.rows) & (col >= 0) & (col < self.cols)

    def center_of(
        self, row: ArrayLike, col: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The cells' centres (x, y) [m] in the map frame."""
        x = self.origin_x + (np.asarray(col) + 0.5) * self.resolution
        y = self.origin_y + (np.asarray(row) + 0.5) * self.resolution
        return x, y
