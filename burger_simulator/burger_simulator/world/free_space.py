"""Where a disc can be in a maze, and what it reaches from the start."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from burger_simulator.world.maze import WALL_THICKNESS, Maze, Wall

CELL = 0.02  # [m] of the flood; distances to walls are exact at the cells' middles


def distances_to_walls(
    x: NDArray[np.float64], y: NDArray[np.float64], walls: tuple[Wall, ...]
) -> NDArray[np.float64]:
    """[m] from each point (n,) to the nearest centre line of a wall; inf where there is none."""
    nearest = np.full(np.shape(x), np.inf)
    for wall in walls:
        ux, uy, length = np.cos(wall.yaw), np.sin(wall.yaw), wall.length
        along = np.clip((x - wall.x0) * ux + (y - wall.y0) * uy, 0.0, length)
        distance = np.hypot(x - wall.x0 - along * ux, y - wall.y0 - along * uy)
        nearest = np.minimum(nearest, distance)
    return nearest


class FreeSpace:
    """Cells in which the middle of a disc touches neither wall nor ramp."""

    def __init__(self, maze: Maze, radius: float) -> None:
        self._maze = maze
        rows, cols = round(maze.height / CELL), round(maze.width / CELL)
        y, x = (np.indices((rows, cols)) + 0.5) * CELL
        self.free = distances_to_walls(x, y, maze.walls) > radius + WALL_THICKNESS / 2
        if maze.ramp is not None:
            along, across = maze.ramp.along_and_across(x, y)  # type: ignore[arg-type]
            outside_x = np.maximum(np.maximum(-along, along - maze.ramp.length), 0.0)
            outside_y = np.maximum(np.abs(across) - maze.ramp.width / 2, 0.0)
            self.free &= np.hypot(outside_x, outside_y) > radius

    @cached_property
    def reachable(self) -> NDArray[np.bool_]:
        """(rows, cols): connected with the start; all False where the start itself is blocked."""
        labels, _ = ndimage.label(self.free)
        label = labels[self._cell(self._maze.start.x, self._maze.start.y)]
        return np.asarray((labels == label) & self.free)

    def reaches(self, x: float, y: float) -> bool:
        row, col = self._cell(x, y)
        rows, cols = self.free.shape
        return 0 <= row < rows and 0 <= col < cols and bool(self.reachable[row, col])

    @staticmethod
    def _cell(x: float, y: float) -> tuple[int, int]:
        return int(np.floor(y / CELL)), int(np.floor(x / CELL))
