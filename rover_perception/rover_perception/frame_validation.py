"""Which frames may change the map, and the pose at which each image was taken."""

from __future__ import annotations

import math

import numpy as np

from rover_common.camera import PinholeCamera
from rover_common.errors import RoverError
from rover_common.geometry import Pose
from rover_common.types import CameraFrame


class FrameError(RoverError, ValueError):
    """A frame that cannot be used; `counter` names the diagnostic that counts it."""

    counter = "frame_invalid"


class ImageSizeError(FrameError):
    counter = "frame_image_size"


class PoseError(FrameError):
    counter = "frame_pose_not_finite"


class OutsideError(FrameError):
    counter = "frame_pose_outside"


class FrameValidator:
    """Validates the frames of one run, in their order, and pairs each image with its pose.

    Live, an image is `image_lag` rendered frames older than the telemetry that carries it. Several
    telemetries of one rendered frame are identical. After an invalid pose the history of poses
    restarts: no older pose is used in place of the missing one.
    """

    def __init__(self, camera: PinholeCamera, world_size: float, image_lag: int) -> None:
        """`world_size` [m]: the edge of the square world."""
        self._image_shape = (camera.height, camera.width, 3)
        self._world_size = world_size
        self._image_lag = image_lag
        self._poses: list[Pose] = []  # of the last rendered frames, oldest first
        self._last: CameraFrame | None = None

    def validate(self, frame: CameraFrame) -> Pose:
        """The pose at which the image was taken.

        Raises ImageSizeError, PoseError or OutsideError; a refused frame changes only the history
        of poses.
        """
        try:
            self._check_pose(frame.pose)
        except FrameError:
            self._poses = []
            raise
        last = self._last
        if last is None or not self._poses or not _same_rendering(last, frame):
            self._poses = [*self._poses, frame.pose][-(self._image_lag + 1) :]
        self._check_image(frame)
        self._last = frame
        return self._poses[0]

    def _check_pose(self, pose: Pose) -> None:
        if not all(map(math.isfinite, (pose.x, pose.y, pose.yaw, pose.pitch, pose.roll))):
            raise PoseError(f"pose is not finite: {pose}")
        if not (0.0 <= pose.x < self._world_size and 0.0 <= pose.y < self._world_size):
            raise OutsideError(f"pose is outside of the world: {pose}")

    def _check_image(self, frame: CameraFrame) -> None:
        if frame.image.shape != self._image_shape:
            raise ImageSizeError(f"image is {frame.image.shape}, expected {self._image_shape}")


def _same_rendering(first: CameraFrame, second: CameraFrame) -> bool:
    return first.pose == second.pose and np.array_equal(first.image, second.image)
