"""One goal of the embedded navigator, as its giver sees it."""

from __future__ import annotations

import math

from rover_common.geometry import Pose
from rover_navigation.navigator import GoalStatus


class EmbeddedGoal:
    """A `GoalHandle`; the navigator writes it, its giver reads it and may cancel it."""

    def __init__(self, pose: Pose, tolerance: float) -> None:
        """tolerance [m] of the position."""
        self.pose = pose
        self.tolerance = tolerance
        self.status = GoalStatus.ACCEPTED
        self.distance_left = math.inf  # [m]
        self.recovering = False
        self.recoveries = 0  # begun
        self.reason = ""

    def cancel(self) -> None:
        """Give it up."""
        self.end(GoalStatus.CANCELLED)

    def end(self, status: GoalStatus, reason: str = "") -> None:
        """Give it a final status; the first one counts."""
        if not self.status.final:
            self.status, self.reason, self.recovering = status, reason, False
