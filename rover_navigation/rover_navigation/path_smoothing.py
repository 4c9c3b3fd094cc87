"""From a chain of cells to a way that a car can drive: smooth, and as fast as its room allows."""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from rover_navigation.costmap import Costmap
from rover_navigation.types import Way

# A corner of 90 degrees averaged over a Gaussian of deviation s is missed by 0.56 s: with the
# spare room as s, half of that room stays.
NEEDED_ROOM = 0.5  # [m] beside a way
SMOOTHING = (0.5, 2.5)  # [m] least and most
WINDOW = 10  # points to either side that count
SPEED_PER_ROOM = 2.2  # [1/s] of a way's speed limit
SLOWEST = 0.8  # [m/s] limit in the narrowest place


def drivable_way(points: NDArray[np.float64], costmap: Costmap) -> Way:
    """The way along `points` (n, 2) [m], about half a metre apart."""
    smooth = _smoothed(points, _room(points, costmap))
    speeds = np.maximum(SLOWEST, SPEED_PER_ROOM * _room(smooth, costmap))
    return Way(smooth, speeds)


def _room(points: NDArray[np.float64], costmap: Costmap) -> NDArray[np.float64]:
    """(n,) [m]"""
    row, col = costmap.geometry.cell_of(points[:, 0], points[:, 1])
    return costmap.room[row, col].astype(np.float64)


def _smoothed(points: NDArray[np.float64], room: NDArray[np.float64]) -> NDArray[np.float64]:
    """Each point as the weighted mean of its neighbours, over a reach that its room allows."""
    if len(points) < 3:
        return points
    steps = np.hypot(*np.diff(points, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    # Reflected in the ends, a way keeps them where they are.
    points, along = (
        np.pad(line, [(WINDOW, WINDOW)] + [(0, 0)] * (line.ndim - 1), "reflect", reflect_type="odd")
        for line in (points, along)
    )
    neighbours = sliding_window_view(points, 2 * WINDOW + 1, axis=0)  # (n, 2, window)
    away = sliding_window_view(along, 2 * WINDOW + 1)
    away = away - away[:, WINDOW : WINDOW + 1]
    reach = np.clip(room - NEEDED_ROOM, *SMOOTHING)[:, None]
    weight = np.exp(-0.5 * (away / reach) ** 2)
    return np.asarray((weight[:, None] * neighbours).sum(axis=2) / weight.sum(axis=1)[:, None])
