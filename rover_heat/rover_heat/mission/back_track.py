"""The robot's own track of level poses, to back along when it tilts."""

from __future__ import annotations

import math
from collections import deque
from typing import Any

from rover_common.geometry import Pose, bearing_to, distance_between
from rover_common.sensor_types import Twist

SPACING = 0.05  # [m] between poses
BACK_LEAST = 0.35  # [m] from where the tilt was noticed to the pose to back to: clear of the marks
REACHED = 0.06  # [m]
SPEED, TURN_GAIN, TURN_MAX = 0.10, 2.0, 0.8  # [m/s], [1/s], [rad/s]
SHARP = math.radians(35.0)  # off the tail or the nose: turns on the spot first


class BackTrack:
    """The last level poses."""

    def __init__(self, count: int) -> None:
        self._poses: deque[Pose] = deque(maxlen=count)

    def update(self, pose: Pose, level: bool) -> None:
        """One tick."""
        far = not self._poses or distance_between(self._poses[-1], pose) >= SPACING
        if level and far:
            self._poses.append(pose)

    def memory(self) -> list[Any]:
        """For JSON."""
        return [[pose.x, pose.y, pose.yaw] for pose in self._poses]

    def restore(self, memory: list[Any]) -> None:
        """Take what `memory` gave; raises ValueError or TypeError for anything else."""
        self._poses.extend([Pose(float(x), float(y), float(yaw)) for x, y, yaw in memory])

    def targets(self, pose: Pose) -> list[Pose]:
        """Poses to back to, the newest first of those that are far enough."""
        away = [p for p in reversed(self._poses) if distance_between(p, pose) >= BACK_LEAST]
        return away or ([self._poses[0]] if self._poses else [])


def towards(target: Pose, pose: Pose) -> Twist:
    """The velocity to a place with the tail or the nose ahead, whichever looks that way."""
    bearing = bearing_to(pose, target.x, target.y)
    behind = abs(bearing) > math.pi / 2
    error = bearing - math.copysign(math.pi, bearing) if behind else bearing
    turn = max(-TURN_MAX, min(TURN_MAX, TURN_GAIN * error))
    if abs(error) > SHARP:
        return Twist(0.0, turn)
    return Twist(-SPEED if behind else SPEED, turn)
