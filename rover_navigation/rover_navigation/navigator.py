"""The seam between a mission and whatever drives its robot to a place.

A mission knows only this protocol. Behind it stand the action navigate_to_pose, which Nav2 and this
package's own navigator both serve, or that navigator itself in the same process.
"""

from __future__ import annotations

from enum import Enum
from typing import Protocol

from rover_common.geometry import Pose


class GoalStatus(Enum):
    """How far a goal has come; the last three are final."""

    ACCEPTED = "accepted"
    DRIVING = "driving"
    REACHED = "reached"
    CANCELLED = "cancelled"
    FAILED = "failed"

    @property
    def final(self) -> bool:
        return self in (GoalStatus.REACHED, GoalStatus.CANCELLED, GoalStatus.FAILED)


class GoalHandle(Protocol):
    """One goal that a navigator was given."""

    @property
    def status(self) -> GoalStatus: ...

    @property
    def distance_left(self) -> float:
        """[m] along the path; inf until one is known."""

    @property
    def recovering(self) -> bool:
        """Whether the navigator is in a recovery, in which the goal need not come nearer."""

    @property
    def reason(self) -> str:
        """Why it failed; empty else."""

    def cancel(self) -> None:
        """Stop, and give the goal up. Nothing happens to a goal that is final."""


class Navigator(Protocol):
    """Drives to poses, one goal at a time; nothing here blocks."""

    @property
    def is_ready(self) -> bool:
        """Whether goals can be given."""

    def go_to(self, pose: Pose, tolerance: float) -> GoalHandle:
        """Drive to a pose of the map frame, within `tolerance` [m]; replaces the goal before."""
