"""What a message must be like for a node to use it, by its type.

A check raises a MessageError and changes nothing. What it lets pass, every conversion takes. Limits
lie far beyond what a robot of this project does, near enough to catch a wrong unit or a wrong byte.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from itertools import chain
from typing import Any

import numpy as np
from action_msgs.msg import GoalStatusArray
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, TransformStamped, Twist, TwistStamped
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rosgraph_msgs.msg import Clock
from rover_interfaces.msg import (
    DriveCommand,
    HeatSourceArray,
    HeatState,
    MissionState,
    NavigationTick,
    PolarArray,
    RockTrackArray,
    RoverStatus,
    SensorTick,
)
from sensor_msgs.msg import CompressedImage, Image, Imu, LaserScan
from std_msgs.msg import Float32MultiArray, Header, Int32, String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from rover_common.ros import images
from rover_common.ros import rover_checks as rover
from rover_common.ros import sensor_checks as sensors
from rover_common.ros.check_values import (
    FARTHEST,
    check_array,
    check_count,
    check_header,
    check_position,
    check_rotation,
    check_text,
    check_time,
    check_within,
)
from rover_common.ros.message_errors import RangeError, SizeError

MOST_CELLS = 16_000_000  # of a map
FINEST, COARSEST = 0.01, 10.0  # [m] edge of a map's cell
TURNED = 1e-3  # of a map's origin: its quaternion's x, y and z, for maps here lie along the axes
MOST_POINTS = 1_000_000
MOST_ITEMS = 10_000  # markers, poses


def check_grid(message: OccupancyGrid) -> None:
    info = message.info
    if not 0 < info.width * info.height == len(message.data) <= MOST_CELLS:
        raise SizeError(f"{len(message.data)} cells for {info.width} x {info.height}")
    check_header(message.header)
    check_within("resolution", info.resolution, FINEST, COARSEST)
    check_position(info.origin.position)
    q = info.origin.orientation
    check_rotation(q)
    if max(abs(q.x), abs(q.y), abs(q.z)) > TURNED:
        raise RangeError("a map that is turned against its frame")
    cells = np.frombuffer(message.data, np.int8)
    if cells.min() < -1 or cells.max() > 100:
        raise RangeError("a cell outside of -1 to 100")


def check_odometry(message: Odometry) -> None:
    check_header(message.header)
    check_text(message.child_frame_id)
    check_position(message.pose.pose.position)
    check_rotation(message.pose.pose.orientation)
    sensors.check_twist(message.twist.twist)


def check_path(message: Path) -> None:
    """Nothing turns by the poses of a path: their rotations are not checked."""
    check_header(message.header)
    check_count("poses", message.poses, MOST_ITEMS)
    for pose in message.poses:
        check_position(pose.pose.position)


def check_markers(message: MarkerArray) -> None:
    check_count("markers", message.markers, MOST_ITEMS)
    for marker in message.markers:
        _check_marker(marker)


def check_transform(message: TransformStamped) -> None:
    check_header(message.header)
    check_text(message.child_frame_id)
    check_position(message.transform.translation)
    check_rotation(message.transform.rotation)


def check_pose(message: PoseStamped) -> None:
    check_header(message.header)
    check_position(message.pose.position)
    check_rotation(message.pose.orientation)


def check_goal_statuses(message: GoalStatusArray) -> None:
    check_count("goals", message.status_list, MOST_ITEMS)


def check_diagnostics(message: DiagnosticArray) -> None:
    check_header(message.header)
    check_count("statuses", message.status, MOST_ITEMS)


def check_any_text(message: String) -> None:
    check_text(message.data)


def check_any_int(_: Int32) -> None:
    """Every number of 32 bits is one."""


def check_clock(message: Clock) -> None:
    check_time(message.clock)


def _check_marker(marker: Marker) -> None:
    check_header(marker.header)
    check_text(marker.ns)
    check_position(marker.pose.position)
    if marker.action == Marker.ADD:
        check_rotation(marker.pose.orientation)
    check_within("scale", marker.scale.x, 0.0, FARTHEST)
    check_within("scale", marker.scale.y, 0.0, FARTHEST)
    check_count("points", marker.points, MOST_POINTS)
    _check_points(marker.points)


def _check_points(points: Iterable[Any]) -> None:
    flat = np.fromiter(chain.from_iterable((p.x, p.y, p.z) for p in points), np.float64)
    check_array("point", flat, np.float64, -FARTHEST, FARTHEST)


def parts_of(message: Any) -> Iterable[Any]:
    """What is checked and taken by itself: one bad transform must not hide the others."""
    return message.transforms if isinstance(message, TFMessage) else (message,)


CHECKS: Mapping[type, Callable[[Any], None]] = {
    Clock: check_clock,
    CompressedImage: sensors.check_jpeg,
    DiagnosticArray: check_diagnostics,
    DriveCommand: rover.check_command,
    Float32MultiArray: sensors.check_thermal,
    GoalStatusArray: check_goal_statuses,
    Header: check_header,
    HeatSourceArray: rover.check_sources,
    HeatState: rover.check_mission,
    Image: images.check_image,
    Imu: sensors.check_imu,
    Int32: check_any_int,
    LaserScan: sensors.check_scan,
    MarkerArray: check_markers,
    MissionState: rover.check_mission,
    NavigationTick: rover.check_navigation_tick,
    OccupancyGrid: check_grid,
    Odometry: check_odometry,
    Path: check_path,
    PolarArray: rover.check_polar,
    PoseStamped: check_pose,
    RockTrackArray: rover.check_rocks,
    RoverStatus: rover.check_status,
    SensorTick: rover.check_sensor_tick,
    String: check_any_text,
    TFMessage: check_transform,  # each of its parts
    TransformStamped: check_transform,
    Twist: sensors.check_twist,
    TwistStamped: sensors.check_stamped_twist,
}
