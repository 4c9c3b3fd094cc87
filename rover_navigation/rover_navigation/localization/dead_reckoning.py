"""Wheel odometry as one continuous track, whatever happens to the frame that it comes in."""

from __future__ import annotations

from typing import Any

from rover_common.geometry import Pose, compose, distance_between, inverse
from rover_common.same_robot import memory_of, odometry_of
from rover_common.sensor_types import WheelOdometry
from rover_navigation.localization.pose_buffer import Trajectory

JUMP = 0.3  # [m] between two messages: not driven


class DeadReckoning:
    """Begins at the origin. A jump counts as no motion, and the drift of the heading that a robot
    shows while it stands is taken off: it is the bias of the gyro."""

    def __init__(self, track: Trajectory) -> None:
        """track: gets the poses."""
        self._track = track
        self._bias = 0.0  # [rad/s]
        self._pose = Pose(0.0, 0.0, 0.0)
        self.newest: WheelOdometry | None = None
        self.jumps = 0
        self._resumes = False  # what comes next follows a gap

    def memory(self) -> dict[str, Any]:
        """But for the track, for JSON."""
        pose, newest = self._pose, self.newest
        return {
            "bias": self._bias,
            "pose": [pose.x, pose.y, pose.yaw],
            "newest": None if newest is None else memory_of(newest),
        }

    def restore(self, memory: dict[str, Any]) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else.

        The message that follows is no jump, however far away: the robot has driven on meanwhile.
        """
        x, y, yaw = memory["pose"]
        self._bias, self._pose = float(memory["bias"]), Pose(float(x), float(y), float(yaw))
        self.newest = odometry_of(memory["newest"])
        self._resumes = True

    def add(self, odometry: WheelOdometry) -> None:
        """One message."""
        last, self.newest = self.newest, odometry
        resumes, self._resumes = self._resumes, False
        far = last is not None and distance_between(last.pose, odometry.pose) > JUMP
        if far and not resumes:
            self.jumps += 1
        elif last is not None:
            moved = compose(inverse(last.pose), odometry.pose)
            drift = self._bias * (odometry.stamp - last.stamp) / 1e9
            self._pose = compose(self._pose, Pose(moved.x, moved.y, moved.yaw - drift))
        self._track.add(odometry.stamp, self._pose)

    def stood(self, turned: float, seconds: float) -> None:
        """The robot stood for some time [s], in which the track turned [rad]."""
        self._bias += turned / seconds

    def odom_in(self, frame: Pose) -> Pose | None:
        """The odometry's own frame as seen from the frame in which the newest pose is `frame`."""
        if self.newest is None:
            return None
        return compose(frame, inverse(self.newest.pose))
