"""The four-point warp: the camera image as a top view, for a rover that stands level."""

from __future__ import annotations

from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA

WIDTH, HEIGHT = ROVER_CAMERA.width, ROVER_CAMERA.height  # [px] of the image and of the top view
# [px] The corners of a square of 1 m in the image, as they were read off a picture of a grid.
SQUARE = np.array([[14, 140], [301, 140], [200, 96], [118, 96]], np.float32)
CELLS_PER_METRE = 10
BOTTOM_OFFSET = 6  # [px] from the lower edge of the top view to the square
# [px] The sides of the square meet here: the top view shows nothing above this row of the image.
FIRST_ROW = 78


@cache
def homography() -> NDArray[np.float64]:
    """(3, 3) from pixels of the image to pixels of the top view."""
    half, bottom = CELLS_PER_METRE / 2, HEIGHT - BOTTOM_OFFSET
    left, right, top = WIDTH / 2 - half, WIDTH / 2 + half, bottom - CELLS_PER_METRE
    square = np.array([[left, bottom], [right, bottom], [right, top], [left, top]], np.float32)
    return np.asarray(cv2.getPerspectiveTransform(SQUARE, square), np.float64)


def top_view(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The image (height, width[, 3]) as seen from above, of the same shape, the rover below it."""
    warped = cv2.warpPerspective(image, homography(), (WIDTH, HEIGHT))
    return np.asarray(warped, np.uint8)


@cache
def field_of_view() -> NDArray[np.bool_]:
    """Pixels (height, width) of the top view that the camera sees."""
    return np.asarray(top_view(np.ones((HEIGHT, WIDTH), np.uint8)) > 0)


def rover_points(mask: NDArray[np.bool_]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Points (x forward, y left) [m] of the pixels of a mask of the top view."""
    row, col = mask.nonzero()
    return (HEIGHT - row) / CELLS_PER_METRE, (WIDTH / 2 - col) / CELLS_PER_METRE
