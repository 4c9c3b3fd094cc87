"""How much of a true map a grid has found to be navigable."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_common.map_encoding import FREE_SHARE, navigable_cells
from rover_common.types import GridMap


def mapped_share(grid: GridMap, truth: NDArray[np.bool_]) -> float:
    """Share 0..1 of the navigable cells (rows, cols) of a truth that are navigable on the grid.

    The grid covers the same ground in cells that divide the truth's.
    """
    rows, cols = truth.shape
    count = len(grid.cells) // rows
    blocks = navigable_cells(grid.cells).reshape(rows, count, cols, count)
    navigable = blocks.mean(axis=(1, 3)) >= FREE_SHARE
    return float(np.count_nonzero(navigable & truth) / np.count_nonzero(truth))
