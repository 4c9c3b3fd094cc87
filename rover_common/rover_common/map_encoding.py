"""What the values of a map's cells mean."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

UNKNOWN = -1
FREE_BELOW = 50  # a published cell of 0..49 counts as navigable
# A cell at the base of a wall, seen from too far away to tell the wall from the ground before it.
EDGE = 50
# Navigable cells of the simulator's map lie about 0.4 m inside the flat floor, and sand looks like
# ground up to 0.1 to 0.3 m from the floor's edge: a navigable cell is free over more than half of
# its area. The value between half and all of it was selected on generated canyons.
FREE_SHARE = 0.65


def navigable_cells(cells: NDArray[np.int8]) -> NDArray[np.bool_]:
    """Cells of an OccupancyGrid (rows, cols) that count as mapped navigable."""
    return (cells >= 0) & (cells < FREE_BELOW)
