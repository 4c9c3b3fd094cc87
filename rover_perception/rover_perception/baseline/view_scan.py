"""The free scan of a top view: the nearest obstacle in each degree of bearing."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from rover_perception.baseline.top_view import field_of_view, rover_points
from rover_perception.mapping.free_scan import COUNT, FIELD, INCREMENT


@cache
def _pixels_by_bearing() -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.intp]]:
    """Flat indices of the pixels in view, bearing by bearing, their distances [m], and the first
    of each of the COUNT bearings.
    """
    x, y = rover_points(field_of_view())
    degree = np.round((np.arctan2(y, x) + FIELD) / INCREMENT).astype(np.intp)
    order = np.argsort(degree, kind="stable")
    order = order[(degree[order] >= 0) & (degree[order] < COUNT)]
    first = np.searchsorted(degree[order], np.arange(COUNT))
    return np.flatnonzero(field_of_view())[order], np.hypot(x, y)[order], first


def nearest_obstacles(obstacle: NDArray[np.bool_]) -> NDArray[np.float64]:
    """(COUNT,) [m] to the nearest pixel of a mask of the top view, inf where there is none."""
    pixel, distance, first = _pixels_by_bearing()
    blocking = np.where(obstacle.reshape(-1)[pixel], distance, np.inf)
    return np.asarray(np.minimum.reduceat(blocking, first))
