"""Goals as their giver knows them: from reports, once a tick, and not in between.

An action tells of its goals that way. The navigator in the same process is asked that way too, so
that a mission goes the same whether or not there is a graph between the two.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from rover_common.geometry import Pose, through_quaternion
from rover_navigation.embedded_goal import EmbeddedGoal
from rover_navigation.embedded_navigator import EmbeddedNavigator
from rover_navigation.navigator import GoalStatus


class ReportedGoal:
    """A `GoalHandle`; the first final status counts."""

    def __init__(self, cancel: Callable[[], None]) -> None:
        """cancel: tells the navigator that the goal is given up."""
        self._cancel = cancel
        self._recoveries = 0
        self.status = GoalStatus.ACCEPTED
        self.distance_left = math.inf  # [m]
        self.recovering = False  # a recovery has begun since the report before
        self.reason = ""

    def report(self, distance: float, recoveries: int) -> None:
        """Feedback: [m] left, where 0 stands for no path yet; recoveries begun so far."""
        if self.status.final:
            return
        self.status = GoalStatus.DRIVING
        self.distance_left = distance if distance > 0.0 else math.inf
        self.recovering = recoveries > self._recoveries
        self._recoveries = recoveries

    def end(self, status: GoalStatus, reason: str = "") -> None:
        """A final status."""
        if not self.status.final:
            self.status, self.reason, self.recovering = status, reason, False

    def cancel(self) -> None:
        """Give it up; what the navigator still does is no concern of the giver."""
        if not self.status.final:
            self.end(GoalStatus.CANCELLED)
            self._cancel()


class ReportingNavigator:
    """A `Navigator` around the one in the same process; `report` after each of its steps."""

    def __init__(self, navigator: EmbeddedNavigator, tolerance: float) -> None:
        """tolerance [m]: of all goals, for an action has none of its own."""
        self._navigator = navigator
        self._tolerance = tolerance
        self._goal: tuple[EmbeddedGoal, ReportedGoal] | None = None

    @property
    def is_ready(self) -> bool:
        """It is always there, as an action's server is."""
        return True

    def go_to(self, pose: Pose, tolerance: float) -> ReportedGoal:
        """Drive to a pose of the map; what is wrong with it is known at the next report."""
        if self._goal is not None:
            self._goal[1].end(GoalStatus.CANCELLED, "replaced by another goal")
        goal = self._navigator.go_to(through_quaternion(pose), self._tolerance)
        reported = ReportedGoal(goal.cancel)
        self._goal = goal, reported
        return reported

    def report(self) -> None:
        """How the goal has got on in a step of the navigator."""
        if self._goal is None:
            return
        goal, reported = self._goal
        if goal.status.final:
            reported.end(goal.status, goal.reason)
            self._goal = None
        else:
            reported.report(feedback_distance(goal.distance_left), goal.recoveries)


def feedback_distance(distance: float) -> float:
    """[m] As the 32 bits of the action's feedback carry it."""
    return float(np.float32(distance))
