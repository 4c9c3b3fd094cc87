"""Breadcrumbs in whole metres, and the way back along them."""

from __future__ import annotations

import math

from rover_common.geometry import Pose

FRAMES = 12  # from one breadcrumb to the next
REACHED = 2.0  # [m] from a breadcrumb


class BreadcrumbTrail:
    """From the start to here, its loops cut out: coming back to a breadcrumb forgets what followed.

    Homeward, the last one is the next to go to, until the rover is near it.
    """

    def __init__(self) -> None:
        self._count = 0
        self._breadcrumbs: list[tuple[int, int]] = []

    def add(self, pose: Pose) -> None:
        """Once per frame on the way out."""
        if self._count % FRAMES == 0:
            self._drop((math.floor(pose.x), math.floor(pose.y)))
        self._count += 1

    def _drop(self, place: tuple[int, int]) -> None:
        if place in self._breadcrumbs:
            del self._breadcrumbs[self._breadcrumbs.index(place) + 1 :]
        else:
            self._breadcrumbs.append(place)

    def follow(self, pose: Pose) -> None:
        """Once per frame on the way home: forget what is reached; the start stays."""
        while len(self._breadcrumbs) > 1 and self._distance(pose) < REACHED:
            self._breadcrumbs.pop()

    @property
    def next(self) -> tuple[float, float] | None:
        """[m] map frame"""
        return self._breadcrumbs[-1] if self._breadcrumbs else None

    def _distance(self, pose: Pose) -> float:
        x, y = self._breadcrumbs[-1]
        return math.hypot(x - pose.x, y - pose.y)
