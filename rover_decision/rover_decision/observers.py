"""Watch the rover over time: does it move, how far has it driven."""

from __future__ import annotations

import math
from collections import deque

from rover_common.geometry import Pose

PROGRESS_DISTANCE = 0.5  # [m]
PROGRESS_TURN = math.radians(30.0)  # turning on the spot is progress too


class ProgressMonitor:
    """Whether the pose has changed within a span of time."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._trail: deque[tuple[float, Pose]] = deque()

    def update(self, time: float, pose: Pose) -> None:
        self._trail.append((time, pose))
        while len(self._trail) > 1 and time - self._trail[1][0] >= self._seconds:
            self._trail.popleft()

    def stuck(self) -> bool:
        """Whether the whole span has passed without progress."""
        (start, _), (end, last) = self._trail[0], self._trail[-1]
        return end - start >= self._seconds and not any(
            _moved(pose, last) for _, pose in self._trail
        )

    def restart(self) -> None:
        """Forget the past: what follows is a new attempt."""
        while len(self._trail) > 1:
            self._trail.popleft()


class Odometer:
    """Distance driven [m]."""

    def __init__(self) -> None:
        self.distance = 0.0
        self._last: Pose | None = None

    def update(self, pose: Pose) -> None:
        if self._last is not None:
            self.distance += math.hypot(pose.x - self._last.x, pose.y - self._last.y)
        self._last = pose


def _moved(a: Pose, b: Pose) -> bool:
    turn = abs((a.yaw - b.yaw + math.pi) % (2 * math.pi) - math.pi)
    return math.hypot(a.x - b.x, a.y - b.y) > PROGRESS_DISTANCE or turn > PROGRESS_TURN
