"""Exact distances on grids of cells."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray


def depth_of(cells: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Of each cell, the distance [cells] to the nearest that is not set; 0 for those.

    The same as `scipy.ndimage.distance_transform_edt`, to the bit and several times as fast. The
    last bits of OpenCV's depend on its number of threads; squares of distances are whole numbers.
    """
    away = cv2.distanceTransform(cells.astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    squares = np.rint(np.square(away, dtype=np.float64))
    return np.sqrt(squares).astype(np.float32)
