"""One goal after the other for the navigator, and how each gets on."""

from __future__ import annotations

import math
from enum import Enum

from rover_common.geometry import Pose
from rover_navigation.navigator import GoalHandle, GoalStatus, Navigator

NEARER, STALLED = 0.05, 15.0  # [m] nearer in [s], or it makes no progress
SLACK, EXTRA = 3.0, 10.0  # times the planned time, and [s], within which to be there
RETURNS = 3  # times that somebody else's goal is driven over


class TripStatus(Enum):
    NONE = "no goal"
    WAITING = "waits for the navigator"
    DRIVING = "on its way"
    REACHED = "reached"
    FAILED = "failed"


class Trip:
    """The newest goal. A goal that our own newer one replaces is no failure of it."""

    def __init__(self, navigator: Navigator) -> None:
        self._navigator = navigator
        self._handle: GoalHandle | None = None
        self._tolerance = 0.0
        self._planned = math.inf  # [s]
        self._begun: float | None = None  # [s] when the navigator took it
        self._nearest = math.inf  # [m]
        self._nearer_at = 0.0  # [s]
        self._returns = 0
        self.goal: Pose | None = None
        self.status = TripStatus.NONE
        self.reason = ""  # why it failed

    def start(self, pose: Pose, tolerance: float, planned: float) -> None:
        """Drive there, within `tolerance` [m]; planned: [s] it should take.

        The navigator drives to the goal before until it takes this one, or until that is canceled.
        """
        self.goal, self._tolerance, self._planned = pose, tolerance, planned
        self._begun, self._returns = None, 0
        self.status, self.reason = TripStatus.WAITING, ""

    def cancel(self) -> None:
        """Give the goal up."""
        if self._handle is not None:
            self._handle.cancel()
        self._handle, self.goal, self.status = None, None, TripStatus.NONE

    def interrupt(self) -> None:
        """The navigator stops; the same goal is given to it again when it may drive."""
        if self._handle is not None:
            self._handle.cancel()
        self._handle = None
        if self.status is TripStatus.DRIVING:
            self.status = TripStatus.WAITING

    def update(self, time: float, navigator_drives: bool) -> None:
        """One tick at a time [s]; when another controller drives, the navigator does not."""
        if not navigator_drives:
            self.interrupt()
        if self.status is TripStatus.WAITING and navigator_drives and self._navigator.is_ready:
            assert self.goal is not None
            self._handle = self._navigator.go_to(self.goal, self._tolerance)
            self.status = TripStatus.DRIVING
            self._begun = time if self._begun is None else self._begun
            self._nearest, self._nearer_at = math.inf, time
        if self.status is TripStatus.DRIVING:
            self._follow(time)

    def _follow(self, time: float) -> None:
        handle = self._handle
        assert handle is not None
        assert self._begun is not None
        left = handle.distance_left
        if handle.recovering or left < self._nearest - NEARER or math.isinf(left):
            self._nearest, self._nearer_at = min(left, self._nearest), time
        if handle.status is GoalStatus.REACHED:
            self.status = TripStatus.REACHED
        elif handle.status is GoalStatus.FAILED:
            self._fail(handle.reason or "the navigator gave it up")
        elif handle.status is GoalStatus.CANCELLED:
            self._drive_again()
        elif time - self._nearer_at > STALLED:
            self._fail(f"no nearer in {STALLED:g} s")
        elif time - self._begun > SLACK * self._planned + EXTRA:
            self._fail("later than planned")

    def _drive_again(self) -> None:
        """Somebody else has cancelled or replaced it."""
        self._handle, self._returns = None, self._returns + 1
        self.status = TripStatus.WAITING
        if self._returns > RETURNS:
            self._fail("cancelled by somebody else")

    def _fail(self, reason: str) -> None:
        if self._handle is not None:
            self._handle.cancel()
        self._handle, self.reason, self.status = None, reason, TripStatus.FAILED
