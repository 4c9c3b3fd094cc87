"""What a sampled trajectory costs: the critics of the controller."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_navigation.costmap import Costmap

# Weights. Nearness to walls counts so much that corners of lanes of 0.6 m are passed at 0.2 m and
# more, which took no more time over three mazes than to pass them at 0.16 m.
COLLISION = 200.0
CLEARANCE, PATH, PROGRESS, GOAL, BACKWARD, TURN, HEADING = 8.0, 8.0, 25.0, 6.0, 8.0, 0.05, 0.5
EVERY = 8  # steps between those whose distance from the path counts


@dataclass(frozen=True)
class Trajectories:
    """(steps, samples) each, after every step."""

    x: NDArray[np.float32]  # [m] map frame
    y: NDArray[np.float32]  # [m]
    yaw: NDArray[np.float32]  # [rad]

    @classmethod
    def empty(cls, shape: tuple[int, int]) -> Trajectories:
        return cls(*(np.empty(shape, np.float32) for _ in range(3)))


@dataclass(frozen=True)
class Scene:
    """What the trajectories are judged by."""

    costmap: Costmap
    path: NDArray[np.float32]  # (n, 2) [m] map frame, what of it lies just ahead; at least 2
    radius: float  # [m] of the body
    inflation: float  # [m] from obstacles up to which ground costs more
    caution: float = 1.0  # share of that cost which counts


def cost_of(
    paths: Trajectories,
    linear: NDArray[np.float32],
    angular: NDArray[np.float32],
    scene: Scene,
) -> NDArray[np.float32]:
    """(samples,)"""
    cost = _clearance_cost(paths, scene)
    cost += _path_cost(paths, scene.path)
    cost += np.float32(BACKWARD) * np.maximum(-linear, 0).mean(axis=0)
    cost += np.float32(TURN) * np.square(angular).mean(axis=0)
    return cost


def _clearance_cost(paths: Trajectories, scene: Scene) -> NDArray[np.float32]:
    """Collisions of the body's disc, by their time: a robot that stands in one leaves; nearness."""
    geometry = scene.costmap.geometry
    scale = np.float32(1.0 / geometry.resolution)
    col = (paths.x - np.float32(geometry.origin_x)) * scale - np.float32(0.5)
    row = (paths.y - np.float32(geometry.origin_y)) * scale - np.float32(0.5)
    clearance = cv2.remap(
        scene.costmap.clearance, col, row, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    near = np.float32(scene.inflation) - clearance
    np.maximum(near, 0, out=near)
    near *= np.float32(1.0 / (scene.inflation - scene.radius))
    cost = np.float32(CLEARANCE * scene.caution) * np.square(near).mean(axis=0)
    hit = clearance < np.float32(scene.radius)
    return cost + np.float32(COLLISION) * hit.mean(axis=0, dtype=np.float32)


def _path_cost(paths: Trajectories, path: NDArray[np.float32]) -> NDArray[np.float32]:
    """Distance from the path, what of it is left at the end, and the heading there."""
    steps = np.diff(path, axis=0)
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    left = np.append(np.cumsum(lengths[::-1])[::-1], np.float32(0))
    along = steps / np.maximum(lengths, np.float32(1e-6))[:, None]  # points may coincide
    along = np.concatenate([along, along[-1:]])  # (points, 2) direction of the path
    x = paths.x[EVERY - 1 :: EVERY, :, None] - path[:, 0]
    y = paths.y[EVERY - 1 :: EVERY, :, None] - path[:, 1]
    square = x * x + y * y  # (some steps, samples, points)
    nearest = square.argmin(axis=2)
    x, y, square = (
        np.take_along_axis(values, nearest[:, :, None], axis=2)[:, :, 0]
        for values in (x, y, square)
    )
    direction = along[nearest]
    passed = x * direction[:, :, 0] + y * direction[:, :, 1]
    to_go = np.abs(left[nearest] - passed)
    cost = np.float32(PATH) * np.sqrt(square).mean(axis=0)
    cost += np.float32(PROGRESS) * to_go[-1] + np.float32(GOAL) * to_go.mean(axis=0)
    aligned = (
        np.cos(paths.yaw[-1]) * direction[-1, :, 0] + np.sin(paths.yaw[-1]) * direction[-1, :, 1]
    )
    return cost + np.float32(HEADING) * (1 - aligned)
