"""A thermal frame as people see it."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

WARM = 8.0  # [K] over the median that is shown brightest: about what a source reads from near

Celsius = NDArray[np.float32]  # (8, 8) [C], row 0 on top, column 0 on the left


def picture_of(celsius: Celsius) -> NDArray[np.uint8]:
    """(8, 8, 3) RGB, from the frame's median to WARM above it; NaN is as the median."""
    return coloured(celsius - np.nanmedian(celsius))


def coloured(excess: NDArray[np.floating]) -> NDArray[np.uint8]:
    """(rows, cols, 3) RGB of an excess (rows, cols) [K]; NaN is none."""
    share = np.nan_to_num(np.clip(excess / WARM, 0.0, 1.0)) * 255
    image = cv2.applyColorMap(share.astype(np.uint8), cv2.COLORMAP_INFERNO)
    return np.asarray(cv2.cvtColor(image, cv2.COLOR_BGR2RGB), np.uint8)


def excess_of(celsius: Celsius) -> NDArray[np.float64]:
    """(8,) [K] of each column's warmest pixel over the frame's median."""
    return np.asarray(celsius.max(axis=0) - np.median(celsius), float)
