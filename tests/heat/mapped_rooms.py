"""Rooms as maps: every wall known, and all ground that is seen from some places."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from warm_room import Room

from rover_common.geometry import Pose
from rover_common.types import GridMap

RESOLUTION = 0.05  # [m]
MARGIN = 0.5  # [m] of unknown cells around the walls
REACH = 8.0  # [m]


def map_of(
    room: Room, seen_from: Iterable[tuple[float, float]], resolution: float = RESOLUTION
) -> GridMap:
    """What a lidar at these places [m] has mapped."""
    low = room.walls.reshape(-1, 2).min(axis=0) - MARGIN
    size = room.walls.reshape(-1, 2).max(axis=0) + MARGIN - low
    cols, rows = (math.ceil(length / resolution) for length in size)
    cells = np.full((rows, cols), -1, np.int8)
    angles = np.linspace(-math.pi, math.pi, 1440, endpoint=False)
    walls = []
    for x, y in seen_from:
        ranges, wall = room.cast(x, y, angles)
        along = np.arange(0.0, REACH, resolution / 2)
        short = along[None] < np.minimum(ranges, REACH)[:, None] - resolution / 2
        free_x = x + along[None] * np.cos(angles)[:, None]
        free_y = y + along[None] * np.sin(angles)[:, None]
        _draw(cells, free_x[short], free_y[short], low, resolution, 0)
        met = wall >= 0
        walls.append((x + (ranges * np.cos(angles))[met], y + (ranges * np.sin(angles))[met]))
    for hit_x, hit_y in walls:
        _draw(cells, hit_x, hit_y, low, resolution, 100)
    return GridMap(resolution, float(low[0]), float(low[1]), cells)


def _draw(
    cells: np.ndarray, x: np.ndarray, y: np.ndarray, low: np.ndarray, resolution: float, value: int
) -> None:
    row = np.floor((y - low[1]) / resolution).astype(int)
    col = np.floor((x - low[0]) / resolution).astype(int)
    inside = (row >= 0) & (row < cells.shape[0]) & (col >= 0) & (col < cells.shape[1])
    cells[row[inside], col[inside]] = value


def is_in(grid: GridMap, pose: Pose | tuple[float, float], value: int) -> bool:
    """Whether the cell at a place has a value."""
    x, y = pose if isinstance(pose, tuple) else (pose.x, pose.y)
    row = math.floor((y - grid.origin_y) / grid.resolution)
    col = math.floor((x - grid.origin_x) / grid.resolution)
    return int(grid.cells[row, col]) == value
