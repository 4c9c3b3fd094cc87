"""Whether the wheels turn and the robot does not get on: something holds it that no sensor sees."""

from __future__ import annotations

from collections import deque

from rover_common.geometry import Pose, distance_between

SECONDS = 1.0  # [s]
TURNED, MOVED = 0.06, 0.015  # [m] of the wheels' path, and of the robot's in that time


class WheelSlip:
    def __init__(self) -> None:
        self._trail: deque[tuple[float, Pose, float]] = deque()  # [s], pose, [m] of wheels' path
        self._way = 0.0  # [m] of the wheels' path

    def update(self, time: float, pose: Pose, speed: float) -> None:
        """One tick; speed [m/s] by the wheels."""
        if self._trail:
            self._way += abs(speed) * (time - self._trail[-1][0])
        self._trail.append((time, pose, self._way))
        while len(self._trail) > 1 and time - self._trail[1][0] >= SECONDS:
            self._trail.popleft()

    def restart(self) -> None:
        """Forget the past: what follows is a new attempt."""
        self._trail.clear()

    @property
    def slips(self) -> bool:
        if len(self._trail) < 2:
            return False
        (start, _, before), (end, last, after) = self._trail[0], self._trail[-1]
        if end - start < SECONDS or after - before < TURNED:
            return False
        return all(distance_between(pose, last) < MOVED for _, pose, _ in self._trail)
