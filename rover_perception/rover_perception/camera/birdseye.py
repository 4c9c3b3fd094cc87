"""The segmented image seen from above, as a picture for people."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_perception.camera.segmentation import Segmentation

CELL = 0.1  # [m] of ground in a pixel: the ten cells per metre of the baseline
ROWS, COLS = 160, 320  # 16 m ahead, and 16 m to either side: as large as the camera's image
OBSTACLE = (255, 0, 0)
ROCK = (0, 255, 0)
NAVIGABLE = (0, 0, 255)

# Centres of the pixels [m] in the level frame: ahead is up, left is left.
AHEAD = ((ROWS - np.arange(ROWS) - 0.5) * CELL)[:, None]
LEFT = ((COLS / 2 - np.arange(COLS) - 0.5) * CELL)[None, :]
DISTANCE = np.hypot(AHEAD, LEFT)


def birdseye_image(segmentation: Segmentation, max_range: float) -> NDArray[np.uint8]:
    """The ground (160, 320, 3) RGB around the rover, which stands at the middle of the lower edge.

    Each pixel has the colour of what the camera's image shows at its place on flat ground:
    obstacles red, rocks green, navigable ground blue. Black is what the image does not show, what
    is beyond `max_range` [m], and where a column does not tell what ends its ground.
    """
    columns = segmentation.columns
    height, width = segmentation.rock_mask.shape
    u, v, depth = segmentation.projection.pixels(AHEAD, LEFT)
    seen = (depth > 0) & (u >= 0) & (u < width) & (v >= 0) & (v < height)
    seen &= max_range >= DISTANCE
    col, row = u[seen].astype(np.intp), v[seen].astype(np.intp)
    whole = np.zeros((ROWS, COLS, 3), np.uint8)
    navigable = v[seen] > columns.reach[col]
    rock = segmentation.rock_mask[row, col] > 0
    whole[seen] = colored(navigable, columns.blocked[col], rock)
    return whole


def colored(
    navigable: NDArray[np.bool_], obstacle: NDArray[np.bool_], rock: NDArray[np.bool_]
) -> NDArray[np.uint8]:
    """Colours (..., 3) RGB of the pixels (...): rock before navigable before obstacle."""
    picture = np.zeros((*navigable.shape, 3), np.uint8)
    picture[obstacle] = OBSTACLE
    picture[navigable] = NAVIGABLE
    picture[rock] = ROCK
    return picture
