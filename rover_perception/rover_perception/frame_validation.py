"""Which frames may touch the map, at which pose their images were taken, and when a run begins."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose
from rover_common.grid import WORLD_SIZE
from rover_common.types import CameraFrame

RESTART_SECONDS = 5.0  # [s] of time falling back: a new run has begun
JUMP = 20.0  # [m] between two frames: a new run as well, the rover drives 5 m/s


class FrameError(ValueError):
    """A frame that cannot be used; its name is its counter."""

    counter = "frame_invalid"


class ImageSizeError(FrameError):
    counter = "frame_image_size"


class PoseError(FrameError):
    counter = "frame_pose_not_finite"


class OutsideError(FrameError):
    counter = "frame_pose_outside"


@dataclass(frozen=True)
class Admission:
    """What is known of a frame before its image is looked at."""

    pose: Pose  # at which the image was taken
    new_run: bool  # the simulator began anew: what was mapped before is of another run


class FrameGate:
    """Refuses what cannot be trusted; pairs each image with its pose.

    Live, an image is a rendered frame older than the telemetry that brings it. Telemetries of one
    rendered frame are alike. Where a pose is missing or time falls back, the pose before is not the
    one that is wanted, and the history begins again with the frame's own.
    """

    def __init__(self, image_lag: int) -> None:
        self._image_lag = image_lag
        self._poses: list[Pose] = []  # of the last rendered frames, oldest first
        self._last: CameraFrame | None = None

    def admit(self, frame: CameraFrame) -> Admission:
        """Raises FrameError; a refused frame changes nothing but the history of poses."""
        try:
            _check_pose(frame.pose)
        except FrameError:
            self._poses = []
            raise
        last = self._last
        fell_back = 0.0 if last is None else 1e-9 * (last.stamp - frame.stamp)
        if fell_back > 0.0:
            self._poses = []
        if last is None or not self._poses or not _same_rendering(last, frame):
            self._poses = [*self._poses, frame.pose][-(self._image_lag + 1) :]
        _check_image(frame)
        self._last = frame
        jumped = (
            last is not None
            and math.hypot(frame.pose.x - last.pose.x, frame.pose.y - last.pose.y) > JUMP
        )
        new_run = jumped or fell_back > RESTART_SECONDS
        if new_run:
            self._poses = [frame.pose]
        return Admission(self._poses[0], new_run)


def _same_rendering(first: CameraFrame, second: CameraFrame) -> bool:
    return first.pose == second.pose and np.array_equal(first.image, second.image)


def _check_pose(pose: Pose) -> None:
    if not all(map(math.isfinite, (pose.x, pose.y, pose.yaw, pose.pitch, pose.roll))):
        raise PoseError(f"pose is not finite: {pose}")
    if not (0.0 <= pose.x < WORLD_SIZE and 0.0 <= pose.y < WORLD_SIZE):
        raise OutsideError(f"pose is outside of the world: {pose}")


def _check_image(frame: CameraFrame) -> None:
    expected = (ROVER_CAMERA.height, ROVER_CAMERA.width, 3)
    if frame.image.shape != expected:
        raise ImageSizeError(f"image is {frame.image.shape}, expected {expected}")
