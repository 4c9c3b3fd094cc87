"""The segmented image as a picture for people."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_perception.camera.segmentation import Segmentation

GROUND = (70, 110, 220)
OBSTACLE = (200, 60, 50)
ROCK = (255, 230, 60)
STRENGTH = 0.5  # opacity of the colour over the image


def vision_image(segmentation: Segmentation) -> NDArray[np.uint8]:
    """The image (height, width, 3) RGB with ground blue, obstacles red and rocks yellow."""
    image, columns = segmentation.image, segmentation.columns
    row = np.arange(image.shape[0])[:, None] + 0.5
    below_horizon = row > columns.horizon
    ground = row > columns.reach
    return paint(image, ground, below_horizon & ~ground, segmentation.rock_mask > 0)


def paint(
    image: NDArray[np.uint8],
    ground: NDArray[np.bool_],
    obstacle: NDArray[np.bool_],
    rock: NDArray[np.bool_],
) -> NDArray[np.uint8]:
    """The image (height, width, 3) RGB with the pixels of each mask (height, width) coloured."""
    picture = image.astype(np.float32)
    for mask, color in ((ground, GROUND), (obstacle, OBSTACLE)):
        picture[mask] = (1 - STRENGTH) * picture[mask] + STRENGTH * np.array(color)
    picture[rock] = ROCK
    return picture.astype(np.uint8)
