"""From a chain of cells to a path that a car can drive: smooth, and as fast as clearance allows."""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from rover_navigation.costmap import Costmap
from rover_navigation.scale import Scale
from rover_navigation.types import Path

WINDOW = 10  # points to either side that count


def smooth_path(points: NDArray[np.float64], costmap: Costmap, scale: Scale) -> Path:
    """The path along `points` (n, 2) [m], about half a metre apart; they may leave the costmap."""
    smooth = _smoothed(points, _clearance(points, costmap), scale)
    speeds = scale.path_speed_per_clearance * _clearance(smooth, costmap)
    return Path(smooth, np.maximum(scale.path_speed_min, speeds))


def _clearance(points: NDArray[np.float64], costmap: Costmap) -> NDArray[np.float64]:
    """(n,) [m], none outside of the costmap: nothing is known there."""
    row, col = costmap.geometry.cell_of(points[:, 0], points[:, 1])
    inside = costmap.geometry.contains(row, col)
    clearance = np.zeros(len(points))
    clearance[inside] = costmap.edge_clearance[row[inside], col[inside]]
    return clearance


def _smoothed(
    points: NDArray[np.float64], clearance: NDArray[np.float64], scale: Scale
) -> NDArray[np.float64]:
    """Each point as the weighted mean of its neighbours, over a reach that clearance allows.

    A corner of 90 degrees averaged over a Gaussian of deviation s is missed by 0.56 s: with the
    spare clearance as s, half of that clearance stays.
    """
    if len(points) < 3:
        return points
    steps = np.hypot(*np.diff(points, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    # Reflected in its ends, a path keeps them where they are.
    points, along = (
        np.pad(line, [(WINDOW, WINDOW)] + [(0, 0)] * (line.ndim - 1), "reflect", reflect_type="odd")
        for line in (points, along)
    )
    neighbours = sliding_window_view(points, 2 * WINDOW + 1, axis=0)  # (n, 2, window)
    away = sliding_window_view(along, 2 * WINDOW + 1)
    away = away - away[:, WINDOW : WINDOW + 1]
    spare = clearance - scale.path_clearance
    reach = np.clip(spare, scale.smoothing_min, scale.smoothing_max)[:, None]
    weight = np.exp(-0.5 * (away / reach) ** 2)
    return np.asarray((weight[:, None] * neighbours).sum(axis=2) / weight.sum(axis=1)[:, None])
