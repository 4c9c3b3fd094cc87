"""From how near each cell of the ground was observed, and where a target may lie unseen."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.types import FreeScan
from rover_navigation.costmap import Costmap
from rover_navigation.scale import Scale
from rover_navigation.types import Coverage

PERIOD = 0.2  # [s] between two updates


class CoverageGrid:
    """Keeps the nearest observation of every cell."""

    def __init__(self, scale: Scale) -> None:
        self._scale = scale
        self._geometry = GridGeometry.of_world(scale.search_cell)
        shape = (self._geometry.rows, self._geometry.cols)
        self._distance = np.full(shape, np.inf, np.float32)
        reach = round(scale.search_range / scale.search_cell)
        steps = np.arange(-reach, reach + 1)
        self._rows, self._cols = (axis.ravel() for axis in np.meshgrid(steps, steps))
        self._updated = -np.inf  # [s]

    def update(self, time: float, pose: Pose, scan: FreeScan) -> None:
        """Observe the cells in view that no obstacle hides, some times a second."""
        if time - self._updated < PERIOD:
            return
        self._updated = time
        scale = self._scale
        row0, col0 = self._geometry.cell_of(pose.x, pose.y)
        row, col = self._rows + row0, self._cols + col0
        x, y = self._geometry.center_of(row, col)
        x, y = x - pose.x, y - pose.y
        distance = np.hypot(x, y)
        cos, sin = math.cos(pose.yaw), math.sin(pose.yaw)
        bearing = np.arctan2(cos * y - sin * x, cos * x + sin * y)
        ray = np.round((bearing - scan.angle_min) / scan.angle_increment).astype(int)
        free = scan.ranges[np.clip(ray, 0, len(scan.ranges) - 1)]
        near = (distance < scale.search_range) & (distance < free + scale.search_slack)
        seen = (near & (np.abs(bearing) < scale.search_field)) | (distance < scale.search_cell)
        seen &= self._geometry.contains(row, col)
        row, col, distance = row[seen], col[seen], distance[seen]
        self._distance[row, col] = np.minimum(self._distance[row, col], distance)

    def restore(self, distance: NDArray[np.float32]) -> None:
        """Take a snapshot's distances; raises ValueError for those of another grid."""
        if distance.shape != self._distance.shape:
            raise ValueError(f"coverage of {distance.shape} cells, not {self._distance.shape}")
        self._distance = distance.astype(np.float32)

    def snapshot(self) -> Coverage:
        """A copy that stays as it is."""
        return Coverage(self._geometry, self._distance.copy())


def unsearched_cells(
    coverage: Coverage, costmap: Costmap, base_reach: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float32]]:
    """Cells of the ground and of the bases of walls beside it.

    Their x and y (n,) [m], and from how near each was observed (n,) [m], inf if never.
    """
    x, y = coverage.geometry.center_of(*np.indices(coverage.distance.shape))
    is_one = np.zeros(x.shape, bool)
    sides = base_reach * np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)])
    for dx, dy in sides:
        row, col = costmap.geometry.cell_of(x + dx, y + dy)
        inside = costmap.geometry.contains(row, col)
        is_one[inside] |= costmap.free[row[inside], col[inside]]
    return x[is_one], y[is_one], coverage.distance[is_one]
