"""The cells that may be in the camera's field of view, listed once per heading."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry

NEAREST = 0.7  # [m] ahead of base_link; the image shows no nearer ground
# The field of view is 54.5 degrees to either side of the optical centre, 0.43 m ahead: tan = 1.4.
WIDTH = 1.5  # [m/m] to either side per distance ahead
HEADINGS = 32


class FieldOfView:
    """For each of HEADINGS headings, the steps from the rover's cell to those that may be seen."""

    def __init__(self, geometry: GridGeometry, max_range: float) -> None:
        """`max_range` [m]: no cell farther away from the rover's is listed."""
        self.geometry = geometry
        self.reach = math.ceil(max_range / geometry.resolution)  # [cells]
        self._by_heading = _cells_by_heading(geometry, self.reach, max_range)

    def cells_at(self, pose: Pose) -> tuple[NDArray, NDArray, NDArray]:
        """Flat indices of cells and their centres (x, y) [m] in the level frame, float32."""
        geometry = self.geometry
        heading = round(pose.yaw / (2.0 * math.pi) * HEADINGS) % HEADINGS
        row, col, cell, north, east = self._by_heading[heading]
        row0, col0 = map(int, geometry.cell_of(pose.x, pose.y))
        center_x, center_y = map(float, geometry.center_of(row0, col0))
        border = min(row0, col0, geometry.rows - 1 - row0, geometry.cols - 1 - col0)
        if border < self.reach:
            inside = np.flatnonzero(geometry.contains(row + row0, col + col0))
            cell, north, east = cell[inside], north[inside], east[inside]
        c, s = math.cos(pose.yaw), math.sin(pose.yaw)
        dx, dy = east + (center_x - pose.x), north + (center_y - pose.y)
        return cell + (row0 * geometry.cols + col0), c * dx + s * dy, c * dy - s * dx


def _cells_by_heading(
    geometry: GridGeometry, reach: int, max_range: float
) -> list[tuple[NDArray, ...]]:
    """Steps in rows, in columns and in flat indices, and north and east [m] as float32."""
    resolution = geometry.resolution
    steps = np.arange(-reach, reach + 1, dtype=np.int32)
    grid_row, grid_col = np.meshgrid(steps, steps, indexing="ij")
    near = np.hypot(grid_row, grid_col) * resolution <= max_range
    row, col = grid_row[near], grid_col[near]
    distance, bearing = np.hypot(row, col) * resolution, np.arctan2(row, col)
    # for half the angle between two headings, and for the rover's position in its cell
    spare = math.pi / HEADINGS + np.arcsin(np.minimum(1.0, resolution / np.maximum(distance, 1e-9)))
    lists = []
    for heading in np.arange(HEADINGS) * 2.0 * math.pi / HEADINGS:
        aside = np.abs((bearing - heading + math.pi) % (2.0 * math.pi) - math.pi)
        inside = (aside < math.atan(WIDTH) + spare) & (distance > NEAREST - resolution)
        cells = row[inside], col[inside]
        metres = ((step * resolution).astype(np.float32) for step in cells)
        flat = cells[0].astype(np.intp) * geometry.cols + cells[1]
        lists.append((*cells, flat, *metres))
    return lists
