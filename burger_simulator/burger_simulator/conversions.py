"""Transforms and clock of the second robot as messages; stamps are [ns]."""

from __future__ import annotations

from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

from burger_simulator.model.robot import IMU_X, IMU_Z
from burger_simulator.sensors.lidar import MOUNTING as LIDAR
from burger_simulator.sensors.thermal import MOUNTING as THERMAL
from rover_common.frames import FRAMES, Frames
from rover_common.geometry import Pose, quaternion_from_pose
from rover_common.ros.conversions import header_of, time_of
from rover_common.sensor_types import WheelOdometry

BASE_LINK_Z = 0.010  # [m] above base_footprint, as in the maker's model file


def body_transform_of(odometry: WheelOdometry, frames: Frames = FRAMES) -> TFMessage:
    """odom -> base_footprint"""
    pose = odometry.pose
    link = _transform(odometry.stamp, frames.odom, frames.footprint, (pose.x, pose.y, 0.0), pose)
    return TFMessage(transforms=[link])


def static_transforms_of(
    stamp: int, thermal_yaws: tuple[float, float], frames: Frames = FRAMES
) -> TFMessage:
    """base_footprint -> base_link -> base_scan, imu_link, thermal_1_link, thermal_2_link"""
    level = Pose(0.0, 0.0, 0.0)
    below = {
        frames.scan: (tuple(map(float, LIDAR)), level),
        frames.imu: ((IMU_X, 0.0, IMU_Z), level),
    }
    for frame, yaw in zip((frames.thermal_1, frames.thermal_2), thermal_yaws, strict=True):
        below[frame] = (tuple(map(float, THERMAL)), Pose(0.0, 0.0, yaw))
    links = [_transform(stamp, frames.footprint, frames.base, (0.0, 0.0, BASE_LINK_Z), level)]
    for child, ((x, y, z), turned) in below.items():
        links.append(_transform(stamp, frames.base, child, (x, y, z - BASE_LINK_Z), turned))
    return TFMessage(transforms=links)


def clock_of(stamp: int) -> Clock:
    """The time of the graph."""
    return Clock(clock=time_of(stamp))


def _transform(
    stamp: int, parent: str, child: str, position: tuple[float, float, float], turned: Pose
) -> TransformStamped:
    x, y, z = position
    qx, qy, qz, qw = quaternion_from_pose(turned)
    return TransformStamped(
        header=header_of(stamp, parent),
        child_frame_id=child,
        transform=Transform(
            translation=Vector3(x=x, y=y, z=z), rotation=Quaternion(x=qx, y=qy, z=qz, w=qw)
        ),
    )
