"""Breadcrumbs: where the rover has been."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose

SPACING = 0.5  # [m] between crumbs


class Crumbs:
    """The trail since the start."""

    def __init__(self) -> None:
        self._points: list[tuple[float, float]] = []

    def drop(self, pose: Pose) -> None:
        """Leave a crumb when the last one is far enough away."""
        point = (pose.x, pose.y)
        if not self._points or np.hypot(*np.subtract(self._points[-1], point)) >= SPACING:
            self._points.append(point)

    @property
    def points(self) -> NDArray[np.float64]:
        """(n, 2) [m] from the start on."""
        return np.array(self._points, float).reshape(-1, 2)
