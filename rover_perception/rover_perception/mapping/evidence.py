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
from rover_perception.camera.ground_projection import View
from rover_perception.camera.segmentation import Columns

EDGE_ERROR = 0.5  # [px] of the row where the ground ends: half a row
FLOOR_ERROR = 0.03  # [m] height of ground that is still bright: the first 0.2 m of a wall's foot
FOOT_DEPTH = 0.5  # [m] of an obstacle behind its foot that is taken as seen
# Behind its foot an obstacle goes on, nobody knows how far. That is worth little, but more than to
# have seen ground there from afar: sand that rises towards a wall looks like ground beyond it.
BODY_DEPTH = 6.0  # [m] of an obstacle that is guessed at, falling with the square of the depth
# A pixel's length on the ground grows with the square of the range; weight is its inverse square.
FULL_WEIGHT_RANGE = 2.0  # [m] up to here, every look counts the same
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
        # the same, but at an edge that was seen too coarsely to tell on which side of it a cell is
        self.edge_looks = np.zeros_like(self.free)
        self._reach = math.ceil(max_range / geometry.resolution)  # cells
        self._ahead = _cells_by_heading(max_range, geometry)

    def add(self, view: View, columns: Columns, pose: Pose) -> tuple[NDArray, NDArray]:
        """Add one frame; returns the level-frame points (x, y) [m] of the cells it saw free."""
        cell, x, y = self._cells_around(pose)
        u, v, depth = view.pixels(x, y)
        in_image = (depth > 0.1) & (u >= 0) & (u < len(columns.reach)) & (v < view.camera.height)
        seen = np.flatnonzero(in_image & (x > NEAR))
        cell, x, y = cell[seen], x[seen], y[seen]
        column, v = u[seen].astype(np.intp), v[seen]
        below = v - columns.horizon.astype(np.float32)[column]
        margin = v - columns.reach.astype(np.float32)[column]  # [px] below the edge
        spread = np.float32(view.height_error + FLOOR_ERROR / view.height)
        error = np.sqrt(EDGE_ERROR**2 + np.square(below * spread))
        is_free = margin > 0
        free = np.flatnonzero(is_free)
        x, y = x[free], y[free]
        self._add_free(cell[free], margin[free] / error[free], x * x + y * y)
        foot = np.flatnonzero(~is_free & columns.blocked[column])
        self._add_blocked(view, cell[foot], margin[foot], below[foot], error[foot])
        return x, y

    def _add_free(self, cell: NDArray, margin: NDArray, squared_distance: NDArray) -> None:
        """`margin` in standard deviations, `squared_distance` [m^2] of each cell."""
        sure = 1.0 - np.exp(-0.5 * np.square(margin))
        _add_at(self.free, cell, sure * _weight(squared_distance))
        _add_at(self.free_looks, cell, sure)

    def _add_blocked(
        self, view: View, cell: NDArray, margin: NDArray, below: NDArray, error: NDArray
    ) -> None:
        """Cells behind an obstacle, by their rows [px] above its foot (negative) and under the
        horizon, and the first one's standard deviation.
        """
        foot = below - margin
        scale = np.float32(view.height * view.camera.focal)  # [m px] range times rows below horizon
        distance = scale / np.maximum(foot, np.float32(0.5))
        behind = scale / np.maximum(below, np.float32(0.1)) - distance
        body = np.flatnonzero(behind < BODY_DEPTH)
        cell, behind = cell[body], np.maximum(behind[body], np.float32(0.01))
        squared_distance = np.square(distance[body])
        foot_rows = scale * FOOT_DEPTH / squared_distance
        sure = 1.0 - np.exp(-0.5 * np.square(foot_rows / error[body]))
        guess = np.minimum(1.0, np.square(FOOT_DEPTH / behind))
        _add_at(self.blocked, cell, sure * guess * _weight(squared_distance))
        near = np.flatnonzero(behind < FOOT_DEPTH)
        # Just behind the foot, that it is an obstacle is no surer than that just before it is none:
        # else the many far looks at an edge would take it for explored.
        beyond = body[near]
        sure_beyond = 1.0 - np.exp(-0.5 * np.square(margin[beyond] / error[beyond]))
        _add_at(self.foot_looks, cell[near], sure[near] * sure_beyond)
        _add_at(self.edge_looks, cell[near], sure[near] * (1.0 - sure_beyond))

    def _cells_around(self, pose: Pose) -> tuple[NDArray, NDArray, NDArray]:
        """Flat indices of the cells that may be in the fan, and their level-frame points [m]."""
        geometry = self.geometry
        ahead = self._ahead[round(pose.yaw / (2.0 * np.pi) * HEADINGS) % HEADINGS]
        row, col, cell, north, east = ahead
        row0, col0 = map(int, geometry.cell_of(pose.x, pose.y))
        center_x, center_y = map(float, geometry.center_of(row0, col0))
        nearest = min(row0, col0, geometry.rows - 1 - row0, geometry.cols - 1 - col0)
        if nearest < self._reach:  # to the grid's border
            inside = np.flatnonzero(geometry.contains(row + row0, col + col0))
            cell, north, east = cell[inside], north[inside], east[inside]
        c, s = math.cos(pose.yaw), math.sin(pose.yaw)
        dx, dy = east + (center_x - pose.x), north + (center_y - pose.y)
        return cell + (row0 * geometry.cols + col0), c * dx + s * dy, c * dy - s * dx


def _cells_by_heading(max_range: float, geometry: GridGeometry) -> list[tuple[NDArray, ...]]:
    """The cells in range for each heading, from the rover's.

    Each as steps in rows, in columns and in flat indices, then north and east [m] as float32.
    """
    resolution = geometry.resolution
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
        flat = cells[0].astype(np.intp) * geometry.cols + cells[1]
        lists.append((*cells, flat, *metres))
    return lists


def _add_at(sums: NDArray, cell: NDArray, amount: NDArray) -> None:
    """Add to the cells of a grid, by their flat indices; faster than `sums[cell] += amount`."""
    np.add.at(sums.reshape(-1), cell, amount)


def _weight(squared_distance: NDArray) -> NDArray:
    """What a look from a distance counts, by its square [m^2]."""
    return np.minimum(1.0, np.square(FULL_WEIGHT_RANGE**2 / squared_distance))
