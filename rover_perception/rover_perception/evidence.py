"""Evidence per cell: how often, and how surely, it was seen free or blocked.

Each frame adds to both sums, so the order of frames does not matter and what was wrong is
outvoted by what is seen better. How sure a frame is of a cell is a matter of pixels: a cell far
below the row where the ground ends is surely free at any range, one at that row is not at all.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_perception.classes import Columns
from rover_perception.view import View

EDGE_ERROR = 0.7  # [px] of the row where the ground ends: JPEG blocks and the median filter
FLOOR_ERROR = 0.03  # [m] height of ground that is still bright: the first 0.2 m of a wall's foot
FOOT_DEPTH = 0.5  # [m] of an obstacle behind its foot that is taken as seen
NEAR = 0.7  # [m] the camera sees no ground nearer than this


class EvidenceGrid:
    """Sums of evidence over the world."""

    def __init__(self, geometry: GridGeometry, max_range: float) -> None:
        self.geometry = geometry
        self.free = np.zeros((geometry.rows, geometry.cols), np.float32)
        self.blocked = np.zeros_like(self.free)
        reach = int(np.ceil(max_range / geometry.resolution))
        steps = np.arange(-reach, reach + 1)
        row, col = np.meshgrid(steps, steps, indexing="ij")
        near = np.hypot(row, col) * geometry.resolution <= max_range
        self._row, self._col = row[near], col[near]

    def add(self, view: View, columns: Columns, pose: Pose) -> tuple[NDArray, NDArray]:
        """Add one frame; returns the level-frame points (x, y) [m] of the cells it saw free."""
        row, col, x, y = self._cells_ahead(pose)
        u, v, depth = view.pixels(x, y)
        width = len(columns.reach)
        seen = (depth > 0.1) & (u >= 0) & (u < width) & (v < view.camera.height)
        row, col, x, y = row[seen], col[seen], x[seen], y[seen]
        u, v = u[seen].astype(np.intp), v[seen]
        below_horizon = v - columns.horizon[u]
        margin = v - columns.reach[u]
        error = np.sqrt(
            EDGE_ERROR**2 + (below_horizon * (view.height_error + FLOOR_ERROR / view.height)) ** 2
        )
        free = margin > 0
        sure = 1.0 - np.exp(-0.5 * (margin[free] / error[free]) ** 2)
        self.free[row[free], col[free]] += sure
        foot = ~free & columns.blocked[u]
        self._add_foot(view, row[foot], col[foot], (v - margin - columns.horizon[u])[foot],
            below_horizon[foot], error[foot])  # fmt: skip
        return x[free], y[free]

    def _add_foot(
        self,
        view: View,
        row: NDArray,
        col: NDArray,
        foot: NDArray,
        cell: NDArray,
        error: NDArray,
    ) -> None:
        """Cells just behind an obstacle's foot; `foot` and `cell` are rows below the horizon."""
        scale = view.height * view.camera.focal  # [m px] range times rows below the horizon
        distance = scale / np.maximum(foot, 0.5)
        behind = scale / np.maximum(cell, 0.1) - distance
        near = behind < FOOT_DEPTH
        depth_in_pixels = scale * FOOT_DEPTH / distance[near] ** 2
        sure = 1.0 - np.exp(-0.5 * (depth_in_pixels / error[near]) ** 2)
        self.blocked[row[near], col[near]] += sure

    def _cells_ahead(self, pose: Pose) -> tuple[NDArray, NDArray, NDArray, NDArray]:
        """Rows and columns inside the grid ahead of the rover, and their level-frame points [m]."""
        geometry = self.geometry
        row0, col0 = geometry.cell_of(pose.x, pose.y)
        center_x, center_y = geometry.center_of(row0, col0)
        c, s = np.cos(pose.yaw), np.sin(pose.yaw)
        dx = self._col * geometry.resolution + (center_x - pose.x)
        dy = self._row * geometry.resolution + (center_y - pose.y)
        x, y = c * dx + s * dy, c * dy - s * dx
        row, col = self._row + row0, self._col + col0
        # the camera's fan: 54.5 degrees either side, tan = 1.4, of a centre 0.43 m ahead
        ahead = (x > NEAR) & (np.abs(y) < 1.5 * x) & geometry.contains(row, col)
        return row[ahead], col[ahead], x[ahead], y[ahead]
