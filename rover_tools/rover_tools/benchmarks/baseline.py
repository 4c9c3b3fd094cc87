"""The perception of the published programs for this rover, as a baseline.

A fixed warp of four points to a view from above, a brightness threshold, a limit of range, no map
update of a tilted frame, and counts per cell of 1 m.
"""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose

WIDTH, HEIGHT = ROVER_CAMERA.width, ROVER_CAMERA.height
SQUARE = np.array([[14, 140], [301, 140], [200, 96], [118, 96]], np.float32)  # 1 m in the image
CELLS_PER_METRE = 10
BOTTOM_OFFSET = 6  # [px] from the image's lower edge to the square, seen from above
BRIGHT = 160
YELLOW = ((110, 110, 0), (255, 255, 70))
MAX_RANGE = 5.0  # [m]
MAX_TILT = math.radians(0.7)
WORLD = 200


class Baseline:
    """Counts of ground, obstacle and rock pixels per cell, (200, 200, 3) in this order."""

    def __init__(self) -> None:
        self.counts = np.zeros((WORLD, WORLD, 3))
        half, bottom = CELLS_PER_METRE / 2, HEIGHT - BOTTOM_OFFSET
        left, right, top = WIDTH / 2 - half, WIDTH / 2 + half, bottom - CELLS_PER_METRE
        above = np.array([[left, bottom], [right, bottom], [right, top], [left, top]], np.float32)
        self._warp = cv2.getPerspectiveTransform(SQUARE, above)

    def process(self, image: NDArray[np.uint8], pose: Pose) -> tuple[NDArray, NDArray]:
        """Add a frame (160, 320, 3); returns distances [m] and bearings [rad] of the ground."""
        above = cv2.warpPerspective(image, self._warp, (WIDTH, HEIGHT))
        in_view = cv2.warpPerspective(np.ones_like(image[:, :, 0]), self._warp, (WIDTH, HEIGHT))
        ground = np.asarray((above > BRIGHT).all(axis=2))
        obstacle = ~ground & (in_view > 0)
        rock = np.asarray(cv2.inRange(above, *YELLOW) > 0)
        level = abs(pose.pitch) < MAX_TILT and abs(pose.roll) < MAX_TILT
        points = [_rover_points(mask) for mask in (ground, obstacle, rock)]
        if level:
            for layer, (x, y) in enumerate(points):
                self._add(layer, x, y, pose)
        x, y = points[0]
        return np.hypot(x, y), np.arctan2(y, x)

    def navigable(self, share: float | None = None) -> NDArray[np.bool_]:
        """Cells (200, 200) ever seen as ground, or in at least a share of all observations."""
        ground, observations = self.counts[..., 0], self.counts[..., :2].sum(axis=2)
        if share is None:
            return np.asarray(ground > 0)
        return np.asarray((ground > 0) & (ground >= share * observations))

    def _add(self, layer: int, x: NDArray, y: NDArray, pose: Pose) -> None:
        near = np.hypot(x, y) < MAX_RANGE
        x, y = x[near], y[near]
        c, s = math.cos(pose.yaw), math.sin(pose.yaw)
        col = np.floor(pose.x + c * x - s * y).astype(int)
        row = np.floor(pose.y + s * x + c * y).astype(int)
        inside = (col >= 0) & (col < WORLD) & (row >= 0) & (row < WORLD)
        self.counts[row[inside], col[inside], layer] += 1


def _rover_points(mask: NDArray[np.bool_]) -> tuple[NDArray, NDArray]:
    """Points (x forward, y left) [m] of the pixels of a mask seen from above."""
    row, col = mask.nonzero()
    return (HEIGHT - row) / CELLS_PER_METRE, (WIDTH / 2 - col) / CELLS_PER_METRE
