"""Goals that the robot has observed, or could not get to, and that are still there."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, bearing_to
from rover_navigation.scale import Scale
from rover_navigation.types import Goal, GoalKind, Plan

OBSERVE_SECONDS = 1.0  # [s] of facing a goal, after which what there was to see has been seen
OUT_OF_REACH = 60.0  # [s] of driving to one goal
BLACKLIST_SECONDS = 150.0  # [s] after which a goal may be tried again that was seen from near
RETRY_SECONDS = 20.0  # [s] the same, of one that was observed from afar for the first time


@dataclass(frozen=True)
class _Observed:
    """A disc in which an observation gave no result."""

    x: float  # [m]
    y: float  # [m]
    radius: float  # [m]
    until: float  # [s] on the blacklist
    certain: bool  # without result from near, out of reach, or not for the first time


class GoalHistory:
    """Watches the goals of the plans."""

    def __init__(self, scale: Scale) -> None:
        self._scale = scale
        self._observed: list[_Observed] = []
        self._goal: Goal | None = None
        self._since = 0.0  # [s] when the goal was set
        self._near_since: float | None = None  # [s]
        self._stamp: int | None = None
        self.missing = 0  # plans in a row without a goal
        # plans in a row that did not find the robot on the map, or with neither goal nor path home
        self.unplaced = 0

    def memory(self) -> list[Any]:
        """All goals that were observed, for JSON."""
        return [dict(vars(place)) for place in self._observed]

    def restore(self, memory: list[Any]) -> None:
        """Take what `memory` gave; raises TypeError for anything else."""
        self._observed = [_Observed(**place) for place in memory]

    @property
    def last(self) -> Goal | None:
        return self._goal

    def update(self, time: float, pose: Pose, plan: Plan | None) -> None:
        """Once per frame, with the plan in force."""
        if plan is None:
            return
        if plan.stamp != self._stamp:
            self._take(time, plan)
        goal = self._goal
        if goal is None or goal.kind is GoalKind.TARGET:
            return
        x, y = plan.path.points[-1]  # where to observe it from
        if math.hypot(x - pose.x, y - pose.y) > self._scale.goal_reached or not self._faces(
            goal, pose
        ):
            self._near_since = None
        elif self._near_since is None:
            self._near_since = time
        observed = self._near_since is not None and time - self._near_since > OBSERVE_SECONDS
        if observed or time - self._since > OUT_OF_REACH:
            distance = math.hypot(goal.x - pose.x, goal.y - pose.y) if observed else 0.0
            self._settle(time, goal, distance, certain=not observed)

    def _take(self, time: float, plan: Plan) -> None:
        """A new plan counts."""
        self._stamp = plan.stamp
        enclosed = plan.goal is None and not math.isfinite(plan.home_seconds)
        self.unplaced = self.unplaced + 1 if enclosed or not plan.placed else 0
        if not self.unplaced:
            self.missing = 0 if plan.goal is not None else self.missing + 1
        if not self._same(plan.goal, self._goal):
            self._since, self._near_since = time, None
        self._goal = plan.goal

    def _settle(self, time: float, goal: Goal, distance: float, certain: bool) -> None:
        """The goal gave no result, observed from a distance [m]."""
        scale = self._scale
        radius = max(scale.goal_radius_min, scale.goal_radius_per_distance * distance)
        certain = certain or distance < scale.goal_afar or self._was_tried(goal)
        until = time + (BLACKLIST_SECONDS if certain else RETRY_SECONDS)
        self._observed.append(_Observed(goal.x, goal.y, radius, until, certain))
        self._since, self._near_since = time, None

    def _was_tried(self, goal: Goal) -> bool:
        return any(math.hypot(goal.x - p.x, goal.y - p.y) < p.radius for p in self._observed)

    def forget(self) -> bool:
        """Take every goal for unobserved again; whether there were any."""
        forgot = bool(self._observed)
        self._observed.clear()
        return forgot

    def retry(self, time: float) -> bool:
        """Take goals for unobserved that were not certain, and make all others retryable.

        Whether there were any.
        """
        certain = [place for place in self._observed if place.certain]
        any_ = len(certain) < len(self._observed) or any(place.until > time for place in certain)
        self._observed = [replace(place, until=min(place.until, time)) for place in certain]
        return any_

    def await_plans(self) -> None:
        """Things have changed: what the plans said until now does not count."""
        self.missing = self.unplaced = 0

    def blacklisted(self, time: float) -> NDArray[np.float64]:
        """Goals not to go to now (n, 3): x, y and radius [m]."""
        return _discs(place for place in self._observed if place.until > time)

    def retryable(self, time: float) -> NDArray[np.float64]:
        """Goals that may be tried again, but gave no result before (n, 3): x, y and radius [m]."""
        return _discs(place for place in self._observed if place.until <= time and place.certain)

    def _faces(self, goal: Goal, pose: Pose) -> bool:
        if math.hypot(goal.x - pose.x, goal.y - pose.y) < self._scale.goal_underfoot:
            return True
        return abs(bearing_to(pose, goal.x, goal.y)) < self._scale.goal_field

    def _same(self, a: Goal | None, b: Goal | None) -> bool:
        if a is None or b is None or a.kind is not b.kind:
            return False
        return math.hypot(a.x - b.x, a.y - b.y) < self._scale.same_goal


def _discs(places: Iterable[_Observed]) -> NDArray[np.float64]:
    return np.array([(place.x, place.y, place.radius) for place in places], float).reshape(-1, 3)
