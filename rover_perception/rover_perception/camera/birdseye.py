"""The segmented image seen from above, as a picture for people."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

from rover_perception.camera.segmentation import Segmentation

CELL = 0.1  # [m] of ground in a pixel: the ten cells per metre of the baseline
ROWS, COLS = 160, 320  # 16 m ahead, and 16 m to either side: as large as the camera's image
OBSTACLE = (255, 0, 0)
ROCK = (0, 255, 0)
NAVIGABLE = (0, 0, 255)

COLORS = np.array([(0, 0, 0), OBSTACLE, NAVIGABLE, ROCK], np.uint8)
# [rad] to either side, beyond which nothing is drawn: the camera sees 54 degrees, some more tilted.
WIDEST = math.radians(60.0)


def birdseye_image(segmentation: Segmentation, max_range: float) -> NDArray[np.uint8]:
    """The ground (160, 320, 3) RGB around the rover, which stands at the middle of the lower edge.

    Each pixel has the colour of what the camera's image shows at its place on flat ground:
    obstacles red, rocks green, navigable ground blue. Black is what the image does not show, what
    is beyond `max_range` [m], and where a column does not tell what ends its ground.
    """
    columns = segmentation.columns
    height, width = segmentation.rock_mask.shape
    pixel, ahead, left = _places(max_range)
    u, v, depth = segmentation.projection.pixels(ahead, left)
    seen = (depth > 0) & (u >= 0) & (u < width) & (v >= 0) & (v < height)
    col, row, v = u[seen].astype(np.intp), v[seen].astype(np.intp), v[seen]
    picture = np.zeros((ROWS * COLS, 3), np.uint8)
    rock = segmentation.rock_mask[row, col] > 0
    picture[pixel[seen]] = colored(v > columns.reach[col], columns.blocked[col], rock)
    return picture.reshape(ROWS, COLS, 3)


def colored(
    navigable: NDArray[np.bool_], obstacle: NDArray[np.bool_], rock: NDArray[np.bool_]
) -> NDArray[np.uint8]:
    """Colours (..., 3) RGB of the pixels (...): rock before navigable before obstacle."""
    shown = obstacle.astype(np.uint8)
    shown[navigable] = 2
    shown[rock] = 3
    return COLORS[shown]


@cache
def _places(max_range: float) -> tuple[NDArray[np.intp], NDArray[np.float32], NDArray[np.float32]]:
    """Pixels (n,) that may be in view, counted by rows, and their places ahead and left (n,) [m].

    In the level frame: ahead is up, left is left.
    """
    row, col = np.indices((ROWS, COLS), np.float32)
    ahead, left = (ROWS - row - 0.5) * CELL, (COLS / 2 - col - 0.5) * CELL
    near = (np.hypot(ahead, left) <= max_range) & (np.abs(np.arctan2(left, ahead)) < WIDEST)
    return np.flatnonzero(near), ahead[near], left[near]
