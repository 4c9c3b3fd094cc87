"""Watch the rover over time: does it move, does it circle, what has it looked at."""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from rover_common.geometry import Pose, wrap_angle
from rover_common.grid import GridGeometry
from rover_common.types import Command, FreeScan
from rover_navigation.types import Searched

PROGRESS_DISTANCE = 0.5  # [m]
PROGRESS_TURN = math.radians(30.0)
# From a stand, the least throttle that is ever given moves the rover by 0.3 m in this time, and a
# turn on the spot by 90 degrees.
HELD_SECONDS = 2.0  # [s]
HELD_DISTANCE, HELD_TURN = 0.05, math.radians(2.0)  # [m] [rad]
CIRCLE_STEERING = math.radians(8.0)  # [rad] to one side all the time
CIRCLE_SECONDS = 10.0  # [s]
SEARCH_RANGE = 6.0  # [m] a rock beyond is rarely seen
SEARCH_CELL = 1.0  # [m]
SEARCH_FIELD = math.radians(45.0)  # [rad] to either side
SEARCH_SLACK = 0.7  # [m] of a cell that may lie beyond the end of the free ground


class ProgressMonitor:
    """Whether the pose has changed within a span of time."""

    def __init__(self, seconds: float, turns_count: bool = True) -> None:
        """turns_count: whether to turn on the spot is progress too."""
        self._seconds = seconds
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
            _moved(pose, last, self._turn) for _, pose in self._trail
        )

    def restart(self) -> None:
        """Forget the past: what follows is a new attempt."""
        while len(self._trail) > 1:
            self._trail.popleft()


class HeldMonitor:
    """Whether something holds the rover: it is told to move, and does not move at all."""

    def __init__(self) -> None:
        self._pose: Pose | None = None
        self._since = 0.0

    def update(self, time: float, pose: Pose, command: Command) -> None:
        """With the command given at this pose."""
        turns = command.steering_angle != 0.0 and command.brake == 0.0
        told = command.throttle != 0.0 or turns
        if not told or self._pose is None or _moved(pose, self._pose, HELD_TURN, HELD_DISTANCE):
            self._pose, self._since = pose, time

    def held(self, time: float) -> bool:
        return self._pose is not None and time - self._since > HELD_SECONDS

    def restart(self, time: float) -> None:
        """Forget the past: what follows is a new attempt."""
        self._pose, self._since = None, time


class CircleMonitor:
    """Whether the rover drives in circles: it has steered to one side for ten seconds."""

    def __init__(self) -> None:
        self._side = 0.0
        self._since = 0.0

    def update(self, time: float, steering_angle: float, driving: bool) -> None:
        side = math.copysign(1.0, steering_angle) if abs(steering_angle) > CIRCLE_STEERING else 0.0
        if side != self._side or not driving:
            self._side, self._since = side, time

    def circling(self, time: float) -> bool:
        return self._side != 0.0 and time - self._since > CIRCLE_SECONDS


class Odometer:
    """Distance driven [m]."""

    def __init__(self) -> None:
        self.distance = 0.0
        self._last: Pose | None = None

    def update(self, pose: Pose) -> None:
        if self._last is not None:
            self.distance += math.hypot(pose.x - self._last.x, pose.y - self._last.y)
        self._last = pose


class SearchedGround:
    """From how near each piece of ground was looked at."""

    def __init__(self) -> None:
        self._geometry = GridGeometry.of_world(SEARCH_CELL)
        shape = (self._geometry.rows, self._geometry.cols)
        self._distance = np.full(shape, np.inf, np.float32)
        reach = round(SEARCH_RANGE / SEARCH_CELL)
        steps = np.arange(-reach, reach + 1)
        self._rows, self._cols = (axis.ravel() for axis in np.meshgrid(steps, steps))

    def update(self, pose: Pose, scan: FreeScan) -> None:
        """Look at the cells in view that no obstacle hides."""
        row0, col0 = self._geometry.cell_of(pose.x, pose.y)
        row, col = self._rows + row0, self._cols + col0
        x, y = self._geometry.center_of(row, col)
        distance = np.hypot(x - pose.x, y - pose.y)
        bearing = np.angle(np.exp(1j * (np.arctan2(y - pose.y, x - pose.x) - pose.yaw)))
        ray = np.round((bearing - scan.angle_min) / scan.angle_increment).astype(int)
        free = scan.ranges[np.clip(ray, 0, len(scan.ranges) - 1)]
        near = (distance < SEARCH_RANGE) & (distance < free + SEARCH_SLACK)
        seen = (near & (np.abs(bearing) < SEARCH_FIELD)) | (distance < 1.0)
        seen &= self._geometry.contains(row, col)
        row, col, distance = row[seen], col[seen], distance[seen]
        self._distance[row, col] = np.minimum(self._distance[row, col], distance)

    def so_far(self) -> Searched:
        return Searched(self._geometry, self._distance.copy())


def _moved(a: Pose, b: Pose, least_turn: float, least_distance: float = PROGRESS_DISTANCE) -> bool:
    turn = abs(wrap_angle(a.yaw - b.yaw))
    return math.hypot(a.x - b.x, a.y - b.y) > least_distance or turn > least_turn
