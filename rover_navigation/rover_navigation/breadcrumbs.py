"""Breadcrumbs: where the robot has been, from its start on."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose


class Breadcrumbs:
    """The trail since the start."""

    def __init__(self, spacing: float) -> None:
        """spacing [m] between two breadcrumbs."""
        self._spacing = spacing
        self._points: list[tuple[float, float]] = []
        self._array: NDArray[np.float64] = np.empty((0, 2))

    def drop(self, pose: Pose) -> None:
        """Leave a breadcrumb when the last one is far enough away."""
        point = (pose.x, pose.y)
        if not self._points or math.dist(self._points[-1], point) >= self._spacing:
            self._points.append(point)

    def restore(self, points: NDArray[np.float64]) -> None:
        """Take a trail (n, 2) [m] to go on from; raises ValueError for anything else."""
        if points.ndim != 2 or points.shape[1] != 2:
            raise ValueError(f"a trail of shape {points.shape}")
        self._points = [(float(x), float(y)) for x, y in points]

    @property
    def points(self) -> NDArray[np.float64]:
        """(n, 2) [m] from the start on; not to be written to."""
        if len(self._array) < len(self._points):
            self._array = np.array(self._points, float).reshape(-1, 2)
        return self._array
