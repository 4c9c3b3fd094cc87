"""Angles, poses and rotations in the conventions of REP-103: SI, x forward, y left, z up."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

ROUNDING = 1e-9  # of the length of a unit quaternion of 64-bit numbers


@dataclass(frozen=True)
class Pose:
    """Pose of base_link in the map frame (ENU).

    The rotation is Rz(yaw) @ Ry(pitch) @ Rx(roll): yaw counter-clockwise from +x, pitch positive
    with the nose down, roll positive with the right side down.
    """

    x: float  # [m]
    y: float  # [m]
    yaw: float  # [rad]
    pitch: float = 0.0  # [rad]
    roll: float = 0.0  # [rad]


def wrap_angle(angle: float) -> float:
    """The same angle in [-pi, pi) [rad]."""
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


def bearing_to(pose: Pose, x: float, y: float) -> float:
    """Bearing [rad], left positive, of a point [m] in the map frame."""
    return wrap_angle(math.atan2(y - pose.y, x - pose.x) - pose.yaw)


def distance_between(a: Pose, b: Pose) -> float:
    """[m] on the ground."""
    return math.hypot(a.x - b.x, a.y - b.y)


def compose(frame: Pose, pose: Pose) -> Pose:
    """A pose that is given in `frame`, in the frame in which `frame` itself is given; planar."""
    cos, sin = math.cos(frame.yaw), math.sin(frame.yaw)
    return Pose(
        frame.x + cos * pose.x - sin * pose.y,
        frame.y + sin * pose.x + cos * pose.y,
        wrap_angle(frame.yaw + pose.yaw),
    )


def compose_points(frame: Pose, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same for points (n, 2) [m]."""
    cos, sin = math.cos(frame.yaw), math.sin(frame.yaw)
    return points @ np.array([(cos, sin), (-sin, cos)]) + (frame.x, frame.y)


def inverse(frame: Pose) -> Pose:
    """The frame in which `frame` is given, as seen from it; planar."""
    cos, sin = math.cos(frame.yaw), math.sin(frame.yaw)
    x = -cos * frame.x - sin * frame.y
    return Pose(x, sin * frame.x - cos * frame.y, wrap_angle(-frame.yaw))


def rotation_matrix(pose: Pose) -> NDArray[np.float64]:
    """Rotation (3, 3) from base_link to the map frame."""
    cy, sy = math.cos(pose.yaw), math.sin(pose.yaw)
    return np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]]) @ tilt_matrix(pose)


def tilt_matrix(pose: Pose) -> NDArray[np.float64]:
    """Rotation (3, 3) from base_link to the level frame below it: pitch and roll without yaw."""
    cp, sp = math.cos(pose.pitch), math.sin(pose.pitch)
    cr, sr = math.cos(pose.roll), math.sin(pose.roll)
    return np.array([[cp, sp * sr, sp * cr], [0.0, cr, -sr], [-sp, cp * sr, cp * cr]])


def quaternion_from_pose(pose: Pose) -> tuple[float, float, float, float]:
    """Unit quaternion (x, y, z, w) of the pose's rotation."""
    cy, sy = math.cos(pose.yaw / 2), math.sin(pose.yaw / 2)
    cp, sp = math.cos(pose.pitch / 2), math.sin(pose.pitch / 2)
    cr, sr = math.cos(pose.roll / 2), math.sin(pose.roll / 2)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def angles_from_quaternion(x: float, y: float, z: float, w: float) -> tuple[float, float, float]:
    """(roll, pitch, yaw) [rad] of a unit quaternion, the inverse of `quaternion_from_pose`."""
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return roll, pitch, yaw


def angles_from_rotation(x: float, y: float, z: float, w: float) -> tuple[float, float, float]:
    """The same of a quaternion that is of length 1 but for rounding, as others send it.

    One of 64-bit numbers is taken bit by bit, so that what is sent and read again stays the same.
    """
    length = math.hypot(x, y, z, w)
    if abs(length - 1.0) > ROUNDING:
        x, y, z, w = x / length, y / length, z / length, w / length
    return angles_from_quaternion(x, y, z, w)


def through_quaternion(pose: Pose) -> Pose:
    """The planar pose that arrives where this one is sent with its rotation as a quaternion."""
    planar = Pose(pose.x, pose.y, pose.yaw)
    _, _, yaw = angles_from_quaternion(*quaternion_from_pose(planar))
    return Pose(pose.x, pose.y, yaw)
