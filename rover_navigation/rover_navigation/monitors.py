"""Watch the robot over time: does it move, does it circle, are its inputs continuous."""

from __future__ import annotations

import math
from collections import deque

from rover_common.geometry import Pose, distance_between, wrap_angle
from rover_common.types import Command
from rover_navigation.scale import Scale

PROGRESS_TURN = math.radians(30.0)
# From a stand, the least throttle that is ever given moves the robot by 0.3 m in this time, and a
# turn in place by 90 degrees.
STALL_SECONDS = 2.0  # [s]
STALL_TURN = math.radians(2.0)
CIRCLE_STEERING = math.radians(8.0)  # [rad] to one side all the time
CIRCLE_SECONDS = 10.0  # [s]
CIRCLE_SPEED = 0.3  # [m/s] below, it turns but does not circle
ON_ONE_SPOT = 25.0  # [s] of turning and observing; no more than two full turns are of use


class ProgressChecker:
    """Whether the pose has changed within a span of time."""

    def __init__(self, seconds: float, distance: float, turns_count: bool = True) -> None:
        """seconds and distance [m] of progress; turns_count: to turn in place is progress too."""
        self._seconds = seconds
        self._distance = distance
        self._turn = PROGRESS_TURN if turns_count else math.inf
        self._trail: deque[tuple[float, Pose]] = deque()

    def update(self, time: float, pose: Pose) -> None:
        self._trail.append((time, pose))
        while len(self._trail) > 1 and time - self._trail[1][0] >= self._seconds:
            self._trail.popleft()

    def stuck(self) -> bool:
        """Whether the whole span has passed without progress."""
        (start, _), (end, last) = self._trail[0], self._trail[-1]
        return end - start >= self._seconds and not any(
            _moved(pose, last, self._turn, self._distance) for _, pose in self._trail
        )

    def restart(self) -> None:
        """Forget the past: what follows is a new attempt."""
        while len(self._trail) > 1:
            self._trail.popleft()


class StallMonitor:
    """Whether something holds the robot: it is told to move, and does not move at all."""

    def __init__(self, distance: float) -> None:
        """distance [m] within which the robot does not move at all."""
        self._distance = distance
        self._pose: Pose | None = None
        self._since = 0.0

    def commanded(self, time: float, pose: Pose, command: Command) -> None:
        """A command was given at this pose."""
        turns = command.steering_angle != 0.0 and command.brake == 0.0
        told = command.throttle != 0.0 or turns
        if not told or self._pose is None or _moved(pose, self._pose, STALL_TURN, self._distance):
            self._pose, self._since = pose, time

    def stalled(self, time: float) -> bool:
        return self._pose is not None and time - self._since > STALL_SECONDS

    def restart(self, time: float) -> None:
        """Forget the past: what follows is a new attempt."""
        self._pose, self._since = None, time


class MotionMonitor:
    """Whether the robot gets on: it moves when told to, makes progress, and leaves the spot."""

    def __init__(self, stuck_seconds: float, scale: Scale) -> None:
        """stuck_seconds: [s] without progress."""
        self._progress = ProgressChecker(stuck_seconds, scale.progress_distance)
        self._travel = ProgressChecker(ON_ONE_SPOT, scale.progress_distance, turns_count=False)
        self._stall = StallMonitor(scale.stall_distance)

    def update(self, time: float, pose: Pose) -> None:
        self._progress.update(time, pose)
        self._travel.update(time, pose)

    def commanded(self, time: float, pose: Pose, command: Command) -> None:
        self._stall.commanded(time, pose, command)

    def stopped_moving(self, time: float) -> bool:
        return self._stall.stalled(time) or self._progress.stuck() or self._travel.stuck()

    def restart(self, time: float, may_stay: bool) -> None:
        """A new attempt; may_stay: also to leave the spot begins anew."""
        self._progress.restart()
        self._stall.restart(time)
        if may_stay:
            self._travel.restart()


class CircleMonitor:
    """Whether the robot drives in circles: it has steered to one side for ten seconds."""

    def __init__(self) -> None:
        self._side = 0.0
        self._since = 0.0

    def commanded(self, time: float, steering_angle: float, driving: bool) -> None:
        side = math.copysign(1.0, steering_angle) if abs(steering_angle) > CIRCLE_STEERING else 0.0
        if side != self._side or not driving:
            self._side, self._since = side, time

    def circling(self, time: float) -> bool:
        return self._side != 0.0 and time - self._since > CIRCLE_SECONDS


class InputMonitor:
    """What lies between two frames: time, a step of the pose, and the distance driven."""

    def __init__(self) -> None:
        self.gap = 0.0  # [s] from the frame before to the newest
        self.jump = 0.0  # [m]
        self.distance = 0.0  # [m] driven in all
        self._last: tuple[float, Pose] | None = None

    def update(self, time: float, pose: Pose) -> None:
        if self._last is not None:
            before, last = self._last
            self.gap = time - before
            self.jump = distance_between(pose, last)
            self.distance += self.jump
        self._last = (time, pose)


def _moved(a: Pose, b: Pose, least_turn: float, least_distance: float) -> bool:
    turn = abs(wrap_angle(a.yaw - b.yaw))
    return distance_between(a, b) > least_distance or turn > least_turn
