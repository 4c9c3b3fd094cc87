"""What a robot that cannot get on tries: to wait, to turn to the free side, to back off."""

from __future__ import annotations

import math
from enum import Enum

from rover_common.geometry import Pose, distance_between
from rover_common.sensor_types import Twist
from rover_navigation.monitors import ProgressChecker

PATIENCE = 2.0  # [s] without progress
PROGRESS = 0.03  # [m] that is progress
CLEAR = 0.3  # [m] from where the trouble was: the next one is another
TURN_RATE, BACK_SPEED = 0.8, 0.1  # [rad/s], [m/s]


class Recovery(Enum):
    WAIT = "waiting"
    TURN = "turning to the free side"
    BACK = "backing off"


# In this order; [s] each, with PATIENCE after each no more than 10 s until it gives up.
SECONDS = {Recovery.WAIT: 1.0, Recovery.TURN: 1.2, Recovery.BACK: 1.0}
ORDER = tuple(SECONDS)


class Recoveries:
    """Of one goal."""

    def __init__(self) -> None:
        self.active: Recovery | None = None
        self._tried = 0
        self._place: Pose | None = None
        self._until = -math.inf
        self._side = 1.0
        self._progress = ProgressChecker(PATIENCE, PROGRESS)
        self._watching = False

    def exhausted(self, pose: Pose) -> bool:
        """Whether everything was tried here."""
        return self._tried >= len(ORDER) and not self._elsewhere(pose)

    def stuck(self, time: float, pose: Pose) -> bool:
        """Whether a robot that drives makes no progress; time [s]."""
        if not self._watching:
            self._progress, self._watching = ProgressChecker(PATIENCE, PROGRESS), True
        self._progress.update(time, pose)
        return self._progress.stuck()

    def begin(self, time: float, pose: Pose, free_side: int) -> None:
        """Try the next one; free_side: +1 left. Not to be called once exhausted."""
        if self._place is None or self._elsewhere(pose):
            self._place, self._tried = pose, 0
        self.active = ORDER[self._tried]
        self._tried += 1
        self._until = time + SECONDS[self.active]
        self._side = float(free_side)

    def twist(self, time: float, may_back: bool) -> Twist | None:
        """The velocity of the active one; None when it is over."""
        if self.active is None:
            return None
        if time >= self._until:
            self.active, self._watching = None, False
            return None
        if self.active is Recovery.TURN:
            return Twist(0.0, self._side * TURN_RATE)
        if self.active is Recovery.BACK and may_back:
            return Twist(-BACK_SPEED, 0.0)
        return Twist()

    def _elsewhere(self, pose: Pose) -> bool:
        return self._place is not None and distance_between(self._place, pose) > CLEAR

    def pause(self) -> None:
        """The robot is held for another reason: what was without progress does not count."""
        self._watching = False
