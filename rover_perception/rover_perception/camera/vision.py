"""What the rover sees, classified, as a picture for people."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_perception.perception import Seen

GROUND = (70, 110, 220)
OBSTACLE = (200, 60, 50)
ROCK = (255, 230, 60)
STRENGTH = 0.5  # of the colour over the image


def vision_image(seen: Seen) -> NDArray[np.uint8]:
    """The image (height, width, 3) RGB: ground blue, obstacles red, rocks yellow, rest as it is."""
    row = np.arange(seen.image.shape[0])[:, None] + 0.5
    below_horizon = row > seen.columns.horizon
    ground = row > seen.columns.reach
    picture = seen.image.astype(np.float32)
    for mask, color in ((ground, GROUND), (below_horizon & ~ground, OBSTACLE)):
        picture[mask] = (1 - STRENGTH) * picture[mask] + STRENGTH * np.array(color)
    picture[seen.rocks > 0] = ROCK
    return picture.astype(np.uint8)
