"""The messages that a telemetry becomes."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from telemetry import telemetry

from rover_bridge import conversions
from rover_bridge.codec import decode_telemetry
from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose, rotation_matrix
from rover_common.types import FIRST_RUN

STAMP = 12_000_000_034


def matrix(transform) -> np.ndarray:
    """(4, 4): coordinates in the child frame to those in the parent frame."""
    t, q = transform.transform.translation, transform.transform.rotation
    result = np.eye(4)
    result[:3, :3] = Rotation.from_quat([q.x, q.y, q.z, q.w]).as_matrix()
    result[:3, 3] = t.x, t.y, t.z
    return result


def test_the_transforms_and_the_camera_info_project_as_the_camera_model_does():
    static = {t.child_frame_id: t for t in conversions.static_transforms_of(STAMP).transforms}
    base_to_optical = matrix(static["camera_link"]) @ matrix(static["camera_optical_frame"])
    info = conversions.camera_info_of(STAMP)
    p = np.reshape(info.p, (3, 4))
    for row, col in ((0, 0), (159, 319), (100, 200)):
        ray = ROVER_CAMERA.rays()[row, col]
        point = np.array([ROVER_CAMERA.forward, 0.0, ROVER_CAMERA.up]) + 3.0 * ray  # base_link
        u, v, w = p @ np.linalg.inv(base_to_optical) @ [*point, 1.0]
        assert (u / w, v / w) == pytest.approx((col, row), abs=1e-3)


def test_the_tree_of_frames_hangs_together():
    static = conversions.static_transforms_of(STAMP).transforms
    (body,) = conversions.body_transform_of(STAMP, Pose(1.0, 2.0, 3.0)).transforms
    edges = {(t.header.frame_id, t.child_frame_id) for t in (*static, body)}
    assert edges == {
        ("map", "odom"),
        ("odom", "base_link"),
        ("base_link", "camera_link"),
        ("camera_link", "camera_optical_frame"),
    }


def test_the_body_transform_is_the_pose():
    pose = Pose(10.0, 20.0, yaw=2.0, pitch=-0.2, roll=0.1)
    (body,) = conversions.body_transform_of(STAMP, pose).transforms
    assert matrix(body)[:3, :3] == pytest.approx(rotation_matrix(pose))
    assert matrix(body)[:2, 3].tolist() == [10.0, 20.0]


def test_the_status_carries_what_the_simulator_said():
    wire = telemetry(steering_angle=0.1, throttle=0.4, brake=0.2, near_sample=True, sim_time=3.5)
    status = conversions.status_of(STAMP, FIRST_RUN, decode_telemetry(wire))
    assert (status.header.stamp.sec, status.header.stamp.nanosec) == (12, 34)
    assert (status.throttle, status.brake) == (0.4, 0.2)
    assert status.steering_angle == pytest.approx(0.1, abs=1e-5)
    assert status.near_sample
    assert not status.picking_up
    assert list(status.sample_y) == [89.84, 96.25]
    assert status.sim_time == 3.5


def test_a_simulator_without_a_clock():
    assert math.isnan(
        conversions.status_of(STAMP, FIRST_RUN, decode_telemetry(telemetry())).sim_time
    )
