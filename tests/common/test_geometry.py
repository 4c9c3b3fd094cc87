"""Poses, rotations and the camera in the conventions of REP-103."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import (
    Pose,
    angles_from_quaternion,
    quaternion_from_pose,
    rotation_matrix,
    tilt_matrix,
    wrap_angle,
)

ANGLE = st.floats(-3.1, 3.1)
TILT = st.floats(-1.5, 1.5)
POSES = st.builds(Pose, st.just(0.0), st.just(0.0), ANGLE, TILT, ANGLE)


@given(POSES)
def test_rotation_is_yaw_pitch_roll(pose):
    expected = Rotation.from_euler("ZYX", (pose.yaw, pose.pitch, pose.roll))
    assert np.allclose(rotation_matrix(pose), expected.as_matrix())
    assert np.allclose(
        rotation_matrix(pose),
        Rotation.from_euler("Z", pose.yaw).as_matrix() @ tilt_matrix(pose),
    )


@given(POSES)
def test_quaternion_and_back(pose):
    quaternion = quaternion_from_pose(pose)
    assert np.allclose(Rotation.from_quat(quaternion).as_matrix(), rotation_matrix(pose))
    roll, pitch, yaw = angles_from_quaternion(*quaternion)
    assert (roll, pitch, yaw) == pytest.approx((pose.roll, pose.pitch, pose.yaw), abs=1e-6)


def test_signs():
    nose_down = rotation_matrix(Pose(0, 0, 0, pitch=0.1)) @ (1, 0, 0)
    assert nose_down[2] < 0
    right_down = rotation_matrix(Pose(0, 0, 0, roll=0.1)) @ (0, -1, 0)
    assert right_down[2] < 0
    assert np.allclose(rotation_matrix(Pose(0, 0, math.pi / 2)) @ (1, 0, 0), (0, 1, 0))


@given(st.floats(-50, 50))
def test_wrap_angle(angle):
    wrapped = wrap_angle(angle)
    assert -math.pi <= wrapped < math.pi
    assert math.isclose(math.cos(wrapped), math.cos(angle), abs_tol=1e-9)
    assert math.isclose(math.sin(wrapped), math.sin(angle), abs_tol=1e-9)


def test_camera_has_seventy_degrees_of_height():
    rays = ROVER_CAMERA.rays()
    assert rays.shape == (160, 320, 3)
    edge = (ROVER_CAMERA.height / 2) / ROVER_CAMERA.focal
    assert math.degrees(2 * math.atan(edge)) == pytest.approx(70.0, abs=1e-3)
    assert rays[0, 0, 1] > 0 > rays[0, -1, 1]  # left is positive
    assert rays[0, 0, 2] > 0 > rays[-1, 0, 2]  # up is positive
