"""How far each place is from the nearest wall of a map."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry


@dataclass(frozen=True)
class DistanceField:
    """Distances are those of cell centres."""

    geometry: GridGeometry
    distance: NDArray[np.float32]  # (rows, cols) [m]

    @classmethod
    def of(cls, geometry: GridGeometry, walls: NDArray[np.bool_]) -> DistanceField:
        """walls (rows, cols): at least one."""
        cells = cv2.distanceTransform((~walls).astype(np.uint8), cv2.DIST_L2, 5)
        return cls(geometry, np.asarray(cells, np.float32) * np.float32(geometry.resolution))

    def at(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n,) [m] at points [m], by the nearest cell centre; the border's outside."""
        row, col = self.geometry.nearest_cell_to(x, y)
        return np.asarray(self.distance[row, col], float)
