"""Breadcrumbs, and the way back along them."""

from __future__ import annotations

import math

from rover_common.geometry import Pose

FRAMES = 12  # from one breadcrumb to the next
SPACING = 1.0  # [m] at least
SAME_PLACE = 3.0  # [m] less than the corridors are wide, where a rover returns along its other wall
LOOP = 6.0  # [m] of trail at least; less is only a bend
REACHED = 2.0  # [m] from a breadcrumb

Place = tuple[float, float]  # [m] map frame


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
            self.drop((pose.x, pose.y))
        self._count += 1

    def drop(self, place: Place) -> None:
        """Keep a place, unless the last one is near, and cut out the loop that it closes."""
        kept = self._breadcrumbs
        if kept and math.dist(kept[-1], place) < SPACING:
            return
        length, trail = 0.0, [*kept, place]
        for index in range(len(kept) - 1, -1, -1):  # from here back to the start
            length += math.dist(trail[index], trail[index + 1])
            if length > LOOP and math.dist(trail[index], place) < SAME_PLACE:
                del kept[index + 1 :]
        kept.append(place)

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
