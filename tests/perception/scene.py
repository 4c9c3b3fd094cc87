"""Flat scenes for perception: images drawn by a ray for each pixel."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ORIGIN_HEIGHT, ROVER_CAMERA
from rover_common.geometry import Pose, rotation_matrix

SAND = (241, 225, 211)
SHADOWED_SAND = (208, 189, 175)
WALL = (36, 25, 21)
SKY = (126, 117, 113)
BRIGHT_SKY = (168, 158, 151)  # low over the horizon, towards the sun
YELLOW = (180, 150, 20)


def ground_points(pose: Pose) -> tuple[NDArray, NDArray, NDArray]:
    """World x, y [m] under each pixel (160, 320), and whether it looks at the ground."""
    rotation = rotation_matrix(pose)
    origin = np.array([pose.x, pose.y, ORIGIN_HEIGHT])
    origin = origin + rotation @ np.array([ROVER_CAMERA.forward, 0.0, ROVER_CAMERA.up])
    rays = ROVER_CAMERA.rays() @ rotation.T
    down = rays[..., 2] < -1e-6
    scale = np.where(down, origin[2] / np.where(down, -rays[..., 2], 1.0), 0.0)
    return origin[0] + scale * rays[..., 0], origin[1] + scale * rays[..., 1], down


def draw(pose: Pose, is_floor, color=SAND) -> NDArray[np.uint8]:
    """The image of a flat world whose floor is where is_floor(x, y) holds; elsewhere dark."""
    x, y, down = ground_points(pose)
    image = np.empty((*x.shape, 3), np.uint8)
    image[:] = SKY
    image[down] = WALL
    image[down & is_floor(x, y)] = color
    return image
