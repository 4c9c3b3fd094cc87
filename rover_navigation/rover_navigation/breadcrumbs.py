"""Breadcrumbs: where the robot has been, from its start on."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose

ROOM = 256  # points


class Breadcrumbs:
    """The trail since the start."""

    def __init__(self, spacing: float) -> None:
        """spacing [m] between two breadcrumbs."""
        self._spacing = spacing
        self._room: NDArray[np.float64] = np.empty((ROOM, 2))  # doubled when it is full
        self._count = 0

    def drop(self, pose: Pose) -> None:
        """Leave a breadcrumb when the last one is far enough away."""
        point = (pose.x, pose.y)
        if self._count and math.dist(self._room[self._count - 1], point) < self._spacing:
            return
        if self._count == len(self._room):
            self._room = np.concatenate([self._room, np.empty_like(self._room)])
        self._room[self._count] = point
        self._count += 1

    def restore(self, points: NDArray[np.float64]) -> None:
        """Take a trail (n, 2) [m] to go on from; raises ValueError for anything else."""
        if points.ndim != 2 or points.shape[1] != 2:
            raise ValueError(f"a trail of shape {points.shape}")
        self._count = len(points)
        self._room = np.concatenate([points, np.empty((ROOM, 2))])

    @property
    def points(self) -> NDArray[np.float64]:
        """(n, 2) [m] from the start on; not to be written to."""
        return self._room[: self._count]
