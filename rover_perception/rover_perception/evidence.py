"""Evidence per cell: how often, how surely and from how near it was seen free or blocked.

Each frame adds to sums, so the order of frames does not matter, and what was wrong is outvoted by
what is seen better. How sure a frame is of a cell is a matter of pixels: a cell far below the row
where the ground ends is surely free at any range, one at that row is not at all. How much that
counts is a matter of range: what errs from afar errs in every frame alike, so that no number of far
looks may outvote a near one.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_perception.classes import Columns
from rover_perception.view import View

EDGE_ERROR = 0.5  # [px] of the row where the ground ends: half a row
FLOOR_ERROR = 0.03  # [m] height of ground that is still bright: the first 0.2 m of a wall's foot
FOOT_DEPTH = 0.5  # [m] of an obstacle behind its foot that is taken as seen
# Behind its foot an obstacle goes on, nobody knows how far. That is worth little, but more than to
# have seen ground there from afar: sand that rises towards a wall looks like ground beyond it.
BODY_DEPTH = 6.0  # [m] of an obstacle that is guessed at, falling with the square of the depth
# A pixel's length on the ground grows with the square of the range; weight is its inverse square.
FULL_WEIGHT_RANGE = 2.0  # [m] up to here, every look counts the same
WEIGHT_POWER = 4
NEAR = 0.7  # [m] the camera sees no ground nearer than this
# The camera's fan: 54.5 degrees to either side of a centre 0.43 m ahead; tan = 1.4.
FAN = 1.5  # [m/m] aside per ahead
HEADINGS = 32  # for each of them, the cells that may lie in the fan are listed once


class EvidenceGrid:
    """Sums of evidence over the world, each (rows, cols)."""

    def __init__(self, geometry: GridGeometry, max_range: float) -> None:
        self.geometry = geometry
        self.free = np.zeros((geometry.rows, geometry.cols), np.float32)  # weighted looks
        self.blocked = np.zeros_like(self.free)  # weighted looks
        # sure looks from any range: at free ground, and at the foot of an obstacle
        self.free_looks = np.zeros_like(self.free)
        self.foot_looks = np.zeros_like(self.free)
        self._ahead = _cells_by_heading(max_range, geometry.resolution)

    def add(self, view: View, columns: Columns, pose: Pose) -> tuple[NDArray, NDArray]:
        """Add one frame; returns the level-frame points (x, y) [m] of the cells it saw free."""
        row, col, x, y = self._cells_ahead(pose)
        u, v, depth = view.pixels(x, y)
        in_image = (u >= 0) & (u < len(columns.reach)) & (v < view.camera.height)
        seen = np.flatnonzero((depth > 0.1) & in_image)
        cell, x, y = row[seen] * self.geometry.cols + col[seen], x[seen], y[seen]
        column, v = u[seen].astype(np.intp), v[seen]
        below = v - columns.horizon.astype(np.float32)[column]
        margin = v - columns.reach.astype(np.float32)[column]
        spread = view.height_error + FLOOR_ERROR / view.height
        error = np.sqrt(EDGE_ERROR**2 + (below * spread) ** 2)
        is_free = margin > 0
        free = np.flatnonzero(is_free)
        self._add_free(cell[free], margin[free] / error[free], np.hypot(x[free], y[free]))
        foot = np.flatnonzero(~is_free & columns.blocked[column])
        self._add_blocked(view, cell[foot], (below - margin)[foot], below[foot], error[foot])
        return x[free], y[free]

    def _add_free(self, cell: NDArray, margin: NDArray, distance: NDArray) -> None:
        """`margin` in standard deviations, `distance` [m] of each cell."""
        sure = 1.0 - np.exp(-0.5 * margin**2)
        self.free.reshape(-1)[cell] += sure * _weight(distance)
        self.free_looks.reshape(-1)[cell] += sure

    def _add_blocked(
        self, view: View, cell: NDArray, foot: NDArray, below: NDArray, error: NDArray
    ) -> None:
        """Cells behind an obstacle; `foot` and `below` are its and their rows under the horizon."""
        scale = view.height * view.camera.focal  # [m px] range times rows below the horizon
        distance = scale / np.maximum(foot, 0.5)
        behind = scale / np.maximum(below, 0.1) - distance
        body = behind < BODY_DEPTH
        cell, distance, behind = cell[body], distance[body], np.maximum(behind[body], 0.01)
        foot_rows = scale * FOOT_DEPTH / distance**2
        sure = 1.0 - np.exp(-0.5 * (foot_rows / error[body]) ** 2)
        guess = np.minimum(1.0, (FOOT_DEPTH / behind) ** 2)
        self.blocked.reshape(-1)[cell] += sure * guess * _weight(distance)
        self.foot_looks.reshape(-1)[cell] += np.where(behind < FOOT_DEPTH, sure, 0.0)

    def _cells_ahead(self, pose: Pose) -> tuple[NDArray, NDArray, NDArray, NDArray]:
        """Rows and columns inside the grid ahead of the rover, and their level-frame points [m]."""
        geometry = self.geometry
        row, col, north, east = self._ahead[round(pose.yaw / (2.0 * np.pi) * HEADINGS) % HEADINGS]
        row0, col0 = geometry.cell_of(pose.x, pose.y)
        center_x, center_y = geometry.center_of(row0, col0)
        c, s = math.cos(pose.yaw), math.sin(pose.yaw)
        dx, dy = east + np.float32(center_x - pose.x), north + np.float32(center_y - pose.y)
        x, y = c * dx + s * dy, c * dy - s * dx
        row, col = row + row0, col + col0
        ahead = np.flatnonzero((x > NEAR) & (np.abs(y) < FAN * x) & geometry.contains(row, col))
        return row[ahead], col[ahead], x[ahead], y[ahead]


def _cells_by_heading(max_range: float, resolution: float) -> list[tuple[NDArray, ...]]:
    """The cells in range for each heading: steps in rows and columns, the same [m] as float32."""
    reach = int(np.ceil(max_range / resolution))
    steps = np.arange(-reach, reach + 1, dtype=np.int32)
    grid_row, grid_col = np.meshgrid(steps, steps, indexing="ij")
    near = np.hypot(grid_row, grid_col) * resolution <= max_range
    row, col = grid_row[near], grid_col[near]
    distance = np.hypot(row, col) * resolution
    # off by half a heading, and by the rover's place in its cell
    spare = math.pi / HEADINGS + np.arcsin(np.minimum(1.0, resolution / np.maximum(distance, 1e-9)))
    headings = np.arange(HEADINGS) * 2.0 * math.pi / HEADINGS
    lists = []
    for heading in headings:
        aside = np.abs(np.angle(np.exp(1j * (np.arctan2(row, col) - heading))))
        inside = (aside < math.atan(FAN) + spare) & (distance > NEAR - resolution)
        cells = row[inside], col[inside]
        metres = ((step * resolution).astype(np.float32) for step in cells)
        lists.append((*cells, *metres))
    return lists


def _weight(distance: NDArray) -> NDArray:
    """What a look from a distance [m] counts."""
    return np.minimum(1.0, (FULL_WEIGHT_RANGE / distance) ** WEIGHT_POWER)
