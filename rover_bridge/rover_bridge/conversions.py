"""Telemetry to messages; stamps are [ns]."""

from __future__ import annotations

import math
from array import array

from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from rosgraph_msgs.msg import Clock
from rover_interfaces.msg import RoverStatus
from sensor_msgs.msg import CameraInfo
from tf2_msgs.msg import TFMessage

from rover_common import frames
from rover_common.camera import ORIGIN_HEIGHT, ROVER_CAMERA
from rover_common.geometry import Pose, quaternion_from_pose
from rover_common.ros.conversions import header_of, time_of
from rover_common.types import Run, Telemetry


def status_of(stamp: int, run: Run, telemetry: Telemetry) -> RoverStatus:
    """In base_link, the samples in the map frame."""
    return RoverStatus(
        header=header_of(stamp, frames.BASE),
        run=run.number,
        run_start=time_of(run.start),
        throttle=telemetry.throttle,
        brake=telemetry.brake,
        steering_angle=telemetry.steering_angle,
        near_sample=telemetry.near_sample,
        picking_up=telemetry.picking_up,
        sample_count=telemetry.sample_count,
        sample_x=array("d", telemetry.samples[:, 0].tolist()),
        sample_y=array("d", telemetry.samples[:, 1].tolist()),
        sim_time=math.nan if telemetry.sim_time is None else telemetry.sim_time,
    )


def camera_info_of(stamp: int) -> CameraInfo:
    """The exact pinhole, in camera_optical_frame."""
    camera = ROVER_CAMERA
    # ROS counts pixel centres as whole numbers, the camera model their left edges.
    cx, cy, f = camera.center_u - 0.5, camera.center_v - 0.5, camera.focal
    return CameraInfo(
        header=header_of(stamp, frames.CAMERA_OPTICAL),
        height=camera.height,
        width=camera.width,
        distortion_model="plumb_bob",
        d=array("d", [0.0] * 5),
        k=[f, 0.0, cx, 0.0, f, cy, 0.0, 0.0, 1.0],
        r=[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        p=[f, 0.0, cx, 0.0, 0.0, f, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    )


def body_transform_of(stamp: int, pose: Pose) -> TFMessage:
    """odom -> base_link"""
    return TFMessage(
        transforms=[
            _transform(
                stamp,
                frames.ODOM,
                frames.BASE,
                (pose.x, pose.y, ORIGIN_HEIGHT),
                quaternion_from_pose(pose),
            )
        ]
    )


def static_transforms_of(stamp: int) -> TFMessage:
    """map -> odom, base_link -> camera_link -> camera_optical_frame"""
    camera = ROVER_CAMERA
    level = (0.0, 0.0, 0.0, 1.0)
    # x right, y down, z forward out of x forward, y left, z up (REP-103)
    optical = (-0.5, 0.5, -0.5, 0.5)
    origin = (0.0, 0.0, 0.0)
    mounting = (camera.forward, 0.0, camera.up)
    return TFMessage(
        transforms=[
            _transform(stamp, frames.MAP, frames.ODOM, origin, level),
            _transform(stamp, frames.BASE, frames.CAMERA, mounting, level),
            _transform(stamp, frames.CAMERA, frames.CAMERA_OPTICAL, origin, optical),
        ]
    )


def clock_of(stamp: int) -> Clock:
    """The time of the graph."""
    return Clock(clock=time_of(stamp))


def _transform(
    stamp: int,
    parent: str,
    child: str,
    position: tuple[float, float, float],
    rotation: tuple[float, float, float, float],
) -> TransformStamped:
    x, y, z = position
    qx, qy, qz, qw = rotation
    return TransformStamped(
        header=header_of(stamp, parent),
        child_frame_id=child,
        transform=Transform(
            translation=Vector3(x=x, y=y, z=z), rotation=Quaternion(x=qx, y=qy, z=qz, w=qw)
        ),
    )
