"""Planar poses as messages and back; stamps are [ns]."""

from __future__ import annotations

from geometry_msgs.msg import (
    Point,
    PoseStamped,
    Quaternion,
    Transform,
    TransformStamped,
    Vector3,
)
from geometry_msgs.msg import Pose as PoseMsg

from rover_common.geometry import Pose, angles_from_quaternion, quaternion_from_pose
from rover_common.ros.conversions import header_of
from rover_common.ros.message_checks import check_finite, check_unit


def transform_message_of(stamp: int, parent: str, child: str, pose: Pose) -> TransformStamped:
    """The frame `child` has the pose in the frame `parent`."""
    return TransformStamped(
        header=header_of(stamp, parent),
        child_frame_id=child,
        transform=Transform(
            translation=Vector3(x=pose.x, y=pose.y, z=0.0), rotation=_quaternion(pose)
        ),
    )


def pose_of_transform(message: TransformStamped) -> Pose:
    """Of the child frame in its parent; raises MessageError."""
    at = message.transform.translation
    check_unit(message.transform.rotation)
    pose = Pose(at.x, at.y, _yaw(message.transform.rotation))
    check_finite("pose", pose.x, pose.y, pose.yaw)
    return pose


def pose_message_of(stamp: int, frame: str, pose: Pose) -> PoseStamped:
    """A pose in a frame."""
    at = PoseMsg(position=Point(x=pose.x, y=pose.y, z=0.0), orientation=_quaternion(pose))
    return PoseStamped(header=header_of(stamp, frame), pose=at)


def pose_of_message(message: PoseStamped) -> Pose:
    """In the frame of its header; raises MessageError."""
    at = message.pose.position
    check_unit(message.pose.orientation)
    return Pose(at.x, at.y, _yaw(message.pose.orientation))


def _quaternion(pose: Pose) -> Quaternion:
    x, y, z, w = quaternion_from_pose(Pose(pose.x, pose.y, pose.yaw))
    return Quaternion(x=x, y=y, z=z, w=w)


def _yaw(q: Quaternion) -> float:
    _, _, yaw = angles_from_quaternion(q.x, q.y, q.z, q.w)
    return yaw
