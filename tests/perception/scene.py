"""Flat scenes for perception: images drawn by a ray for each pixel, and drives through them."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ORIGIN_HEIGHT, ROVER_CAMERA
from rover_common.geometry import Pose, rotation_matrix
from rover_common.types import CameraFrame
from rover_perception.config import PerceptionConfig
from rover_perception.perception import Perception

SAND = (241, 225, 211)
SHADOWED_SAND = (208, 189, 175)
WALL = (36, 25, 21)
SKY = (126, 117, 113)
BRIGHT_SKY = (168, 158, 151)  # low over the horizon, towards the sun

EXACT = PerceptionConfig(image_lag=0)  # images are taken at the poses they come with
PERIOD = 40_000_000  # [ns] between two frames


def ground_points(pose: Pose) -> tuple[NDArray, NDArray, NDArray]:
    """World x, y [m] that each pixel (160, 320) shows, and whether it shows the ground."""
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


def corridor(x: NDArray, y: NDArray) -> NDArray[np.bool_]:
    """Floor between two walls along x."""
    return (y > 95.0) & (y < 105.0)


def hall(x: NDArray, y: NDArray) -> NDArray[np.bool_]:
    """The same with a wall at its end."""
    return corridor(x, y) & (x < 100.0)


def drive(pitch: float = 0.0, roll: float = 0.0, count: int = 40) -> list[Pose]:
    """Poses along the corridor, the rover turning from side to side."""
    turn = math.radians(35)
    return [Pose(90 + 0.5 * i, 100.0, turn * math.sin(0.4 * i), pitch, roll) for i in range(count)]


def frames(poses: list[Pose], is_floor: Callable) -> list[CameraFrame]:
    return [
        CameraFrame(1 + index * PERIOD, pose, draw(pose, is_floor))
        for index, pose in enumerate(poses)
    ]


def mapped(frames: list[CameraFrame], config: PerceptionConfig = EXACT) -> NDArray[np.int8]:
    """The cells of the world map that the frames add up to."""
    core = Perception(config)
    for frame in frames:
        core.process(frame)
    return core.world_map().cells
