"""Breadcrumbs in whole metres, and the way back along them."""

from __future__ import annotations

import math

from rover_common.geometry import Pose

FRAMES = 12  # from one breadcrumb to the next
SAME_PLACE = 3.0  # [m] less than the corridors are wide, where a rover returns along its other wall
REACHED = 2.0  # [m] from a breadcrumb

Place = tuple[int, int]  # [m]


class BreadcrumbTrail:
    """From the start to here, its loops cut out: coming back to a breadcrumb forgets what followed.

    Homeward, the last one is the next to go to, until the rover is near it.
    """

    def __init__(self) -> None:
        self._count = 0
        self._breadcrumbs: list[Place] = []

    def add(self, pose: Pose) -> None:
        """Once per frame on the way out."""
        if self._count % FRAMES == 0:
            self._drop((math.floor(pose.x), math.floor(pose.y)))
        self._count += 1

    def _drop(self, place: Place) -> None:
        for index, earlier in enumerate(self._breadcrumbs):
            if math.dist(earlier, place) < SAME_PLACE:
                del self._breadcrumbs[index + 1 :]
                return
        self._breadcrumbs.append(place)

    def follow(self, pose: Pose) -> None:
        """Once per frame on the way home: forget what is reached; the start stays."""
        while len(self._breadcrumbs) > 1 and self._is_reached(pose):
            self._breadcrumbs.pop()

    @property
    def next(self) -> Place | None:
        """The one to go to."""
        return self._breadcrumbs[-1] if self._breadcrumbs else None

    def _is_reached(self, pose: Pose) -> bool:
        return math.dist(self._breadcrumbs[-1], (pose.x, pose.y)) < REACHED
