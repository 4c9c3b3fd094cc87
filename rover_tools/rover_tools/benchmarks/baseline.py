"""Perception as published programs for this rover do it: the baseline of the benchmark.

A fixed four-point warp to a top view, a brightness threshold, a range limit, no map update from a
tilted frame, and counts per cell of 1 m.
"""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose
from rover_common.grid import GridGeometry

WIDTH, HEIGHT = ROVER_CAMERA.width, ROVER_CAMERA.height
SQUARE = np.array([[14, 140], [301, 140], [200, 96], [118, 96]], np.float32)  # 1 m in the image
CELLS_PER_METRE = 10
BOTTOM_OFFSET = 6  # [px] from the lower edge of the top view to the square
BRIGHT = 160
YELLOW = ((110, 110, 0), (255, 255, 70))
MAX_RANGE = 5.0  # [m]
MAX_TILT = math.radians(0.7)
GRID = GridGeometry.of_world(1.0)


class BaselinePerception:
    """`counts` (rows, cols, 3): pixels of ground, obstacle and rock per cell, in this order."""

    def __init__(self) -> None:
        self.counts = np.zeros((GRID.rows, GRID.cols, 3))
        half, bottom = CELLS_PER_METRE / 2, HEIGHT - BOTTOM_OFFSET
        left, right, top = WIDTH / 2 - half, WIDTH / 2 + half, bottom - CELLS_PER_METRE
        square = np.array([[left, bottom], [right, bottom], [right, top], [left, top]], np.float32)
        self._warp = cv2.getPerspectiveTransform(SQUARE, square)

    def process(self, image: NDArray[np.uint8], pose: Pose) -> tuple[NDArray, NDArray]:
        """Add a frame (160, 320, 3); returns distances [m] and bearings [rad] of the ground."""
        top_view = cv2.warpPerspective(image, self._warp, (WIDTH, HEIGHT))
        in_view = cv2.warpPerspective(np.ones_like(image[:, :, 0]), self._warp, (WIDTH, HEIGHT))
        ground = np.asarray((top_view > BRIGHT).all(axis=2))
        obstacle = ~ground & (in_view > 0)
        rock = np.asarray(cv2.inRange(top_view, *YELLOW) > 0)
        level = abs(pose.pitch) < MAX_TILT and abs(pose.roll) < MAX_TILT
        points = [_rover_points(mask) for mask in (ground, obstacle, rock)]
        if level:
            for layer, (x, y) in enumerate(points):
                self._add(layer, x, y, pose)
        x, y = points[0]
        return np.hypot(x, y), np.arctan2(y, x)

    def navigable(self, share: float | None = None) -> NDArray[np.bool_]:
        """Cells (rows, cols) with ground in any, or in at least a share, of their observations."""
        ground, observations = self.counts[..., 0], self.counts[..., :2].sum(axis=2)
        if share is None:
            return np.asarray(ground > 0)
        return np.asarray((ground > 0) & (ground >= share * observations))

    def _add(self, layer: int, x: NDArray, y: NDArray, pose: Pose) -> None:
        near = np.hypot(x, y) < MAX_RANGE
        x, y = x[near], y[near]
        c, s = math.cos(pose.yaw), math.sin(pose.yaw)
        row, col = GRID.cell_of(pose.x + c * x - s * y, pose.y + s * x + c * y)
        inside = GRID.contains(row, col)
        self.counts[row[inside], col[inside], layer] += 1


def _rover_points(mask: NDArray[np.bool_]) -> tuple[NDArray, NDArray]:
    """Points (x forward, y left) [m] of the pixels of a mask of the top view."""
    row, col = mask.nonzero()
    return (HEIGHT - row) / CELLS_PER_METRE, (WIDTH / 2 - col) / CELLS_PER_METRE
