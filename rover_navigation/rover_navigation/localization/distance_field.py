"""How far each place is from the nearest wall of a map, with the slope there."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry


@dataclass(frozen=True)
class DistanceField:
    """Distances are those of cell centres, bilinear in between."""

    geometry: GridGeometry
    distance: NDArray[np.float32]  # (rows, cols) [m]

    @classmethod
    def of(cls, geometry: GridGeometry, walls: NDArray[np.bool_]) -> DistanceField:
        """walls (rows, cols): at least one."""
        cells = cv2.distanceTransform((~walls).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        return cls(geometry, np.asarray(cells, np.float32) * np.float32(geometry.resolution))

    def at(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n,) [m] at points [m], by the nearest cell centre; the border's outside."""
        row, col = self.geometry.nearest_cell_to(x, y)
        return np.asarray(self.distance[row, col], float)

    def with_slope(self, points: NDArray[np.float64]) -> tuple[NDArray, NDArray]:
        """Distance (n,) [m] at points (n, 2) [m], and its derivative (n, 2) by x and y.

        Points outside are taken to the border.
        """
        geometry = self.geometry
        col = (points[:, 0] - geometry.origin_x) / geometry.resolution - 0.5
        row = (points[:, 1] - geometry.origin_y) / geometry.resolution - 0.5
        col0 = np.clip(np.floor(col).astype(np.intp), 0, geometry.cols - 2)
        row0 = np.clip(np.floor(row).astype(np.intp), 0, geometry.rows - 2)
        u, v = np.clip(col - col0, 0.0, 1.0), np.clip(row - row0, 0.0, 1.0)
        at = row0 * geometry.cols + col0
        values = self.distance.ravel()
        d00, d01 = values[at], values[at + 1]
        d10, d11 = values[at + geometry.cols], values[at + geometry.cols + 1]
        below, above = d00 + u * (d01 - d00), d10 + u * (d11 - d10)
        slope_x = (d01 - d00) * (1.0 - v) + (d11 - d10) * v
        slope = np.stack([slope_x, above - below], axis=1) / geometry.resolution
        return below + v * (above - below), slope
