"""The measured profile of the canyon's walls: height and sand by distance from the flat floor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

# The map of navigable cells is this much tighter than the flat floor [m].
MAP_MARGIN = 0.4

# Distance outside of the flat floor [m], and the median height there [m].
_OUTSIDE = (0.0, 0.1, 0.2, 0.3, 0.5, 0.8, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 10.0, 20.0)
_HEIGHT = (0.0, 0.015, 0.044, 0.093, 0.26, 0.66, 1.02, 2.1, 3.5, 6.1, 10.3, 15.7, 18.7, 21.0)

# Distance outside of the flat floor [m], and how the heights there spread around their median:
# the standard deviation of their logarithm, from the quarter and three-quarter points. Nearer than
# 2 m more was measured, but there it is the place of the edge between heights 0.39 m apart.
_SPREAD_AT = (0.0, 2.0, 3.0, 5.0, 8.0, 10.0)
_SPREAD = (0.35, 0.42, 0.38, 0.35, 0.24, 0.18)

# Distance outside of the flat floor [m], negative inside, and the share of bright sand there.
_SAND_AT = (-2.0, -1.5, -1.0, -0.8, -0.5, -0.3, -0.1, 0.1, 0.2, 0.3, 0.5)
_SAND = (1.0, 0.99, 0.88, 0.82, 0.79, 0.74, 0.5, 0.32, 0.18, 0.09, 0.01)


def height_at(outside: NDArray[np.floating]) -> NDArray[np.float64]:
    """Median height [m] at a distance [m] outside of the flat floor, 0 inside."""
    return np.interp(outside, _OUTSIDE, _HEIGHT)


def spread_at(outside: NDArray[np.floating]) -> NDArray[np.float64]:
    """Standard deviation of the height's logarithm at a distance [m] outside of the floor."""
    return np.interp(outside, _SPREAD_AT, _SPREAD)


def sand_at(outside: NDArray[np.floating]) -> NDArray[np.float64]:
    """Median share of bright sand, 0..1, at a distance [m] outside of the flat floor."""
    return np.interp(outside, _SAND_AT, _SAND)
