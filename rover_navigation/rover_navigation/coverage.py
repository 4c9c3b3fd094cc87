"""Where a rock may lie that nobody has seen: on the ground, or on the foot of a wall beside it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_navigation.costmap import Costmap
from rover_navigation.types import Searched

# [m] A cell with free ground this near to its middle, on any side, is the foot of a wall: it counts
# as looked at only when the look reached to it, and no other wall was in the way.
FOOT = 0.6
SIDES = FOOT * np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)])


def hiding_places(
    searched: Searched, costmap: Costmap
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float32]]:
    """Their x and y (n,) [m], and from how near each was looked at (n,) [m], inf if never."""
    x, y = searched.geometry.center_of(*np.indices(searched.distance.shape))
    is_one = np.zeros(x.shape, bool)
    for aside, along in SIDES:
        row, col = costmap.geometry.cell_of(x + aside, y + along)
        inside = costmap.geometry.contains(row, col)
        is_one[inside] |= costmap.free[row[inside], col[inside]]
    return x[is_one], y[is_one], searched.distance[is_one]
