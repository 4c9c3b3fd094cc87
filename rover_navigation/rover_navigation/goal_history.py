"""Goals that the rover has been at, or could not get to, and that are still there."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_navigation.path_tracking import bearing_to
from rover_navigation.types import Goal, GoalKind, Plan

AT_GOAL = 1.2  # [m]
LINGER = 1.0  # [s] of looking at a goal, after which what there was to see has been seen
FACING = math.radians(40.0)  # [rad] a goal further aside is not looked at: the camera sees 54
UNDERFOOT = 1.0  # [m] the camera sees no ground nearer than this, wherever it looks
OUT_OF_REACH = 60.0  # [s] on the way to one goal
FORGET = 150.0  # [s] after which a goal may be tried again that was seen from near
RETRY = 20.0  # [s] the same, of one that was looked at from afar for the first time
SAME = 4.0  # [m] between two plans' goals
# What a look in vain has settled: a disc around what was looked at, the wider the farther off.
LEAST_RADIUS = 1.5  # [m]
FROM_AFAR = 4.0  # [m] what was looked at from farther off may still be a way on
RADIUS_PER_DISTANCE = 0.4


@dataclass(frozen=True)
class _Visited:
    x: float  # [m]
    y: float  # [m]
    radius: float  # [m]
    until: float  # [s] to be left alone
    surely: bool  # in vain from near, out of reach, or not for the first time


class GoalMemory:
    """Watches the goals of the plans."""

    def __init__(self) -> None:
        self._visited: list[_Visited] = []
        self._goal: Goal | None = None
        self._since = 0.0  # [s] when the goal was set
        self._near_since: float | None = None  # [s]
        self._stamp: int | None = None
        self.missing = 0  # plans in a row without a goal
        # plans in a row that did not find the rover on the map, or with neither goal nor way home
        self.unplaced = 0

    @property
    def last(self) -> Goal | None:
        return self._goal

    def update(self, time: float, pose: Pose, plan: Plan | None) -> None:
        if plan is None:
            return
        if plan.stamp != self._stamp:
            self._stamp = plan.stamp
            enclosed = plan.goal is None and not math.isfinite(plan.home_seconds)
            self.unplaced = self.unplaced + 1 if enclosed or not plan.placed else 0
            if not self.unplaced:
                self.missing = 0 if plan.goal is not None else self.missing + 1
            if not _same(plan.goal, self._goal):
                self._since, self._near_since = time, None
            self._goal = plan.goal
        goal = self._goal
        if goal is None or goal.kind is GoalKind.ROCK:
            return
        x, y = plan.way.points[-1]  # where to look at it from
        if math.hypot(x - pose.x, y - pose.y) > AT_GOAL or not _in_view(goal, pose):
            self._near_since = None
        elif self._near_since is None:
            self._near_since = time
        lingered = self._near_since is not None and time - self._near_since > LINGER
        if lingered or time - self._since > OUT_OF_REACH:
            distance = math.hypot(goal.x - pose.x, goal.y - pose.y) if lingered else 0.0
            radius = max(LEAST_RADIUS, RADIUS_PER_DISTANCE * distance)
            surely = not lingered or distance < FROM_AFAR or self._was_tried(goal)
            until = time + (FORGET if surely else RETRY)
            self._visited.append(_Visited(goal.x, goal.y, radius, until, surely))
            self._since, self._near_since = time, None

    def _was_tried(self, goal: Goal) -> bool:
        return any(math.hypot(goal.x - p.x, goal.y - p.y) < p.radius for p in self._visited)

    def forget_visited(self) -> bool:
        """Take every place for unvisited again; whether there were any."""
        forgot = len(self._visited) > 0
        self._visited.clear()
        return forgot

    def doubt_visited(self, time: float) -> bool:
        """Take places for unvisited that were not seen surely, and doubt all others from now on.

        Whether there were any.
        """
        known = [place for place in self._visited if place.surely]
        doubted = len(known) < len(self._visited) or any(place.until > time for place in known)
        self._visited = [replace(place, until=min(place.until, time)) for place in known]
        return doubted

    def await_plans(self) -> None:
        """Things have changed: what the plans said until now does not count."""
        self.missing = self.unplaced = 0

    def visited(self, time: float) -> NDArray[np.float64]:
        """Places not to go to now (n, 3): x, y and radius [m]."""
        return _discs(place for place in self._visited if place.until > time)

    def doubtful(self, time: float) -> NDArray[np.float64]:
        """Places that may be tried again (n, 3), but were in vain before: x, y and radius [m]."""
        return _discs(place for place in self._visited if place.until <= time and place.surely)


def _discs(places: Iterable[_Visited]) -> NDArray[np.float64]:
    return np.array([(place.x, place.y, place.radius) for place in places], float).reshape(-1, 3)


def _in_view(goal: Goal, pose: Pose) -> bool:
    if math.hypot(goal.x - pose.x, goal.y - pose.y) < UNDERFOOT:
        return True
    return abs(bearing_to(pose, goal.x, goal.y)) < FACING


def _same(a: Goal | None, b: Goal | None) -> bool:
    if a is None or b is None or a.kind is not b.kind:
        return False
    return math.hypot(a.x - b.x, a.y - b.y) < SAME
