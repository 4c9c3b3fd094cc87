"""Samples of an inertial unit by hand."""

from __future__ import annotations

import math

from rover_common.geometry import Pose, quaternion_from_pose
from rover_common.sensor_types import Imu

GRAVITY = 9.81  # [m/s^2]


def imu(
    stamp: int, roll: float = 0.0, pitch: float = 0.0, rates: tuple[float, ...] = (0.0, 0.0, 0.0),
    orientation: str = "measured",
) -> Imu:  # fmt: skip
    """Of a body at rest, tilted [rad]; orientation: measured, none or zero."""
    quaternion = quaternion_from_pose(Pose(0.0, 0.0, 0.3, pitch, roll))
    orientations = {"measured": quaternion, "none": None, "zero": (0.0, 0.0, 0.0, 0.0)}
    level = GRAVITY * math.cos(pitch)
    force = (-GRAVITY * math.sin(pitch), level * math.sin(roll), level * math.cos(roll))
    return Imu(stamp, orientations[orientation], tuple(rates), force)
