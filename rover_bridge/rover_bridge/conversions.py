"""Telemetry to messages; stamps are [ns]."""

from __future__ import annotations

import math
from array import array

from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from rosgraph_msgs.msg import Clock
from rover_interfaces.msg import RoverStatus
from sensor_msgs.msg import CameraInfo
from tf2_msgs.msg import TFMessage

from rover_common.camera import ORIGIN_HEIGHT, ROVER_CAMERA
from rover_common.frames import FRAMES, Frames
from rover_common.geometry import Pose, quaternion_from_pose
from rover_common.ros.conversions import header_of, time_of
from rover_common.types import Run, Telemetry


def status_of(stamp: int, run: Run, telemetry: Telemetry, frames: Frames = FRAMES) -> RoverStatus:
    """In base_link, the samples in the map frame."""
    return RoverStatus(
        header=header_of(stamp, frames.base),
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


def camera_info_of(stamp: int, frames: Frames = FRAMES) -> CameraInfo:
    """The exact pinhole, in camera_optical_frame."""
    camera = ROVER_CAMERA
    # ROS counts pixel centres as whole numbers, the camera model their left edges.
    cx, cy, f = camera.center_u - 0.5, camera.center_v - 0.5, camera.focal
    return CameraInfo(
        header=header_of(stamp, frames.camera_optical),
        height=camera.height,
        width=camera.width,
        distortion_model="plumb_bob",
        d=array("d", [0.0] * 5),
        k=[f, 0.0, cx, 0.0, f, cy, 0.0, 0.0, 1.0],
        r=[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        p=[f, 0.0, cx, 0.0, 0.0, f, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    )


def body_transform_of(stamp: int, pose: Pose, frames: Frames = FRAMES) -> TFMessage:
    """odom -> base_link"""
    return TFMessage(
        transforms=[
            _transform(
                stamp,
                frames.odom,
                frames.base,
                (pose.x, pose.y, ORIGIN_HEIGHT),
                quaternion_from_pose(pose),
            )
        ]
    )


def static_transforms_of(
    stamp: int, frames: Frames = FRAMES, camera_frames: bool = True
) -> TFMessage:
    """map -> odom, and with `camera_frames` base_link -> camera_link -> camera_optical_frame"""
    camera = ROVER_CAMERA
    level = (0.0, 0.0, 0.0, 1.0)
    # x right, y down, z forward out of x forward, y left, z up (REP-103)
    optical = (-0.5, 0.5, -0.5, 0.5)
    origin = (0.0, 0.0, 0.0)
    mounting = (camera.forward, 0.0, camera.up)
    below_base = [
        _transform(stamp, frames.base, frames.camera, mounting, level),
        _transform(stamp, frames.camera, frames.camera_optical, origin, optical),
    ]
    to_odom = _transform(stamp, frames.map, frames.odom, origin, level)
    return TFMessage(transforms=[to_odom, *(below_base if camera_frames else [])])


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
