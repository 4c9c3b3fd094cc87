"""Which frames may touch the map, and at which pose their images were taken."""

from __future__ import annotations

import math

import numpy as np

from rover_common.camera import ROVER_CAMERA
from rover_common.errors import RoverError
from rover_common.geometry import Pose
from rover_common.grid import WORLD_SIZE
from rover_common.types import CameraFrame


class FrameError(RoverError, ValueError):
    """A frame that cannot be used; its name is its counter."""

    counter = "frame_invalid"


class ImageSizeError(FrameError):
    counter = "frame_image_size"


class PoseError(FrameError):
    counter = "frame_pose_not_finite"


class OutsideError(FrameError):
    counter = "frame_pose_outside"


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

    def admit(self, frame: CameraFrame) -> Pose:
        """The pose at which the image was taken.

        Raises FrameError; a refused frame changes nothing but the history of poses.
        """
        try:
            _check_pose(frame.pose)
        except FrameError:
            self._poses = []
            raise
        last = self._last
        if last is not None and frame.stamp < last.stamp:
            self._poses = []
        if last is None or not self._poses or not _same_rendering(last, frame):
            self._poses = [*self._poses, frame.pose][-(self._image_lag + 1) :]
        _check_image(frame)
        self._last = frame
        return self._poses[0]


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
