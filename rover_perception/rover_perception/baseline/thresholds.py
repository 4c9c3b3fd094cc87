"""Thresholds of colour: which pixels of an image or of a top view are ground, and which a rock."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

# Least and most red, green and blue, inclusive: of ground, and of a rock
BRIGHT = ((161, 161, 161), (255, 255, 255))
YELLOW = ((110, 110, 0), (255, 255, 70))


def ground_mask(image: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Pixels (height, width) that are ground."""
    return np.asarray(cv2.inRange(image, *BRIGHT) > 0)


def rock_mask(image: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Pixels (height, width) that are a rock sample."""
    return np.asarray(cv2.inRange(image, *YELLOW) > 0)
