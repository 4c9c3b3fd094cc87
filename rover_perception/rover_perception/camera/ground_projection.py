"""The projection between pixels and flat ground at one frame's pitch and roll.

The level frame is base_link without pitch and roll: the same origin, x forward along the yaw, y
left, z up. Pixel coordinates are continuous: pixel (0, 0) spans 0 to 1 in both directions.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ORIGIN_HEIGHT, PinholeCamera
from rover_common.geometry import Pose, tilt_matrix
from rover_common.vehicle import ROVER

Array = NDArray[np.floating]

# Beyond the suspension's stops the body pivots about two wheels, which lifts its origin.
WHEEL_LEVER = 0.36  # [m] origin to wheel: mean of 0.386 front and 0.336 rear; 0.396 to the sides
LOWEST_CAMERA = 0.1  # [m] below this the rover has turned over
LEAST_UPRIGHT = 0.5  # cosine of the body's tilt: 60 degrees


@dataclass(frozen=True)
class GroundProjection:
    """The projection of one frame; not `usable` when the rover lies on its side or back."""

    camera: PinholeCamera
    tilt: Array  # (3, 3) base_link to level frame
    position: tuple[float, float, float]  # [m] of the optical centre, level frame, ground at z = 0
    height_error: float  # relative error of the camera's height, from the tilt

    @classmethod
    def of(cls, camera: PinholeCamera, pose: Pose) -> GroundProjection:
        tilt = tilt_matrix(pose)
        x, y, z = tilt @ (camera.forward, 0.0, camera.up)
        lifted = sum(
            math.sin(max(0.0, abs(angle) - stop))
            for angle, stop in ((pose.pitch, ROVER.pitch_stop), (pose.roll, ROVER.roll_stop))
        )
        height = z + ORIGIN_HEIGHT
        error = WHEEL_LEVER * lifted / max(height, LOWEST_CAMERA)
        return cls(camera, tilt, (float(x), float(y), float(height)), error)

    @property
    def height(self) -> float:
        """Of the optical centre above the ground [m]."""
        return self.position[2]

    @property
    def usable(self) -> bool:
        return self.height > LOWEST_CAMERA and self.tilt[2, 2] > LEAST_UPRIGHT

    def horizon(self, u: Array) -> Array:
        """Row of the horizon in each column u [px]."""
        first, last = self._horizon_at_edges()
        return first + (last - first) / self.camera.width * u

    @property
    def highest_horizon(self) -> float:
        """Row of the horizon [px] at the image's left or right edge, whichever is higher."""
        return min(self._horizon_at_edges())

    def _horizon_at_edges(self) -> tuple[float, float]:
        """Rows of the horizon [px], a straight line, at the image's left and right edge."""
        camera = self.camera
        ahead, left, up = self.tilt[2].tolist()
        left_edge = camera.center_u / camera.focal
        right_edge = (camera.center_u - camera.width) / camera.focal
        return (
            camera.center_v + camera.focal * (ahead + left * left_edge) / up,
            camera.center_v + camera.focal * (ahead + left * right_edge) / up,
        )

    def ground(self, u: Array, v: Array, level: float = 0.0) -> tuple[Array, Array]:
        """Points (x, y) [m] of the level frame that the pixels (u, v) show.

        The points lie on a plane `level` [m] above the ground. Pixels at the horizon or above it
        give inf.
        """
        left = (self.camera.center_u - u) / self.camera.focal
        up = (self.camera.center_v - v) / self.camera.focal
        t = self.tilt.tolist()
        down = -(t[2][0] + t[2][1] * left + t[2][2] * up)
        scale = np.where(down > 0, (self.height - level) / np.maximum(down, 1e-12), np.inf)
        x = self.position[0] + scale * (t[0][0] + t[0][1] * left + t[0][2] * up)
        y = self.position[1] + scale * (t[1][0] + t[1][1] * left + t[1][2] * up)
        return x, y

    def pixels(self, x: Array, y: Array) -> tuple[Array, Array, Array]:
        """Pixels (u, v) of ground points [m] of the level frame, and their depth [m].

        Pixels of points with a depth below 0.01 m, in or behind the camera, are meaningless.
        """
        dx, dy, dz = x - self.position[0], y - self.position[1], -self.height
        t = self.tilt.tolist()  # Python floats keep the precision of the arrays
        depth = t[0][0] * dx + t[1][0] * dy + t[2][0] * dz
        left = t[0][1] * dx + t[1][1] * dy + t[2][1] * dz
        up = t[0][2] * dx + t[1][2] * dy + t[2][2] * dz
        scale = self.camera.focal / np.maximum(depth, 0.01)
        return self.camera.center_u - left * scale, self.camera.center_v - up * scale, depth
