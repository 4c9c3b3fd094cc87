"""Exact distances on grids of cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage


def depth_of(cells: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Of each cell, the distance [cells] to the nearest that is not set; 0 for those.

    Not by OpenCV, whose last bits differ from run to run: worlds must be the same everywhere.
    """
    return np.asarray(ndimage.distance_transform_edt(cells), np.float32)
