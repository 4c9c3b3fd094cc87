"""Ways home: which one is taken, and the next one when it does not get on."""

from __future__ import annotations

import math

import numpy as np

from rover_common.geometry import Pose, wrap_angle
from rover_common.types import PolarArray
from rover_navigation.path_tracking import remaining
from rover_navigation.types import NO_WAY, Plan, Way

BREADCRUMBS, SHORTEST_PATH, BEARING = METHODS = ("breadcrumbs", "shortest_path", "bearing")
PATIENCE = 20.0  # [s] within which a way must have brought the rover nearer
NEARER = 3.0  # [m]
MOST_TROUBLES = 2  # times that the rover gets stuck on one way


class WayHome:
    """The way in force; starts with the preferred method."""

    def __init__(self, preferred: str) -> None:
        self._turn = METHODS.index(preferred)
        self._best, self._since = math.inf, 0.0
        self._troubles = 0

    @property
    def method(self) -> str:
        return METHODS[self._turn % len(METHODS)]

    def begin(self, time: float) -> None:
        """Set out, or go on after an interruption: the clock starts anew."""
        self._best, self._since = math.inf, time

    def trouble(self) -> None:
        """The rover got stuck on the way in force, which is left when that happens again."""
        self._troubles += 1
        if self._troubles >= MOST_TROUBLES:
            self._next()

    def update(self, time: float, pose: Pose, home: tuple[float, float], plan: Plan | None) -> Way:
        """The way to follow now; empty when there is none, as for the bearing."""
        way = NO_WAY
        if self.method != BEARING and plan is not None and len(plan.home_way):
            way = remaining(plan.home_way, pose)
        left = _length(way, pose, home)
        if left < self._best - NEARER:
            self._best, self._since = left, time
        if time - self._since > PATIENCE:
            self._next()
            self.begin(time)
        return way

    def _next(self) -> None:
        self._turn += 1
        self._troubles = 0


def bearing_home(nav: PolarArray, pose: Pose, home: tuple[float, float]) -> float | None:
    """Of the middle half of the navigable bearings, the one [rad] closest to home's."""
    if len(nav.bearings) == 0:
        return None
    wanted = wrap_angle(math.atan2(home[1] - pose.y, home[0] - pose.x) - pose.yaw)
    low, high = np.percentile(nav.bearings, (25, 75))
    return float(np.clip(wanted, low, high))


def _length(way: Way, pose: Pose, home: tuple[float, float]) -> float:
    """What is left of a way [m], or of the straight line where there is none."""
    if len(way) == 0:
        return math.hypot(home[0] - pose.x, home[1] - pose.y)
    steps = np.hypot(*np.diff(way.points, axis=0).T)
    return float(steps.sum()) + math.hypot(*(way.points[0] - (pose.x, pose.y)))
