"""What the nodes make of a message that has passed its check."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from geometry_msgs.msg import PoseStamped, TransformStamped, Twist, TwistStamped
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rover_interfaces.msg import (
    DriveCommand,
    HeatSourceArray,
    HeatState,
    MissionState,
    PolarArray,
    RockTrackArray,
    RoverStatus,
    SensorTick,
)
from sensor_msgs.msg import Image, Imu, LaserScan
from std_msgs.msg import Float32MultiArray
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from rover_bridge.codec import encode_drive
from rover_common.ros import conversions, scan_conversions, transforms
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.message_checks import CHECKS, parts_of
from rover_common.ros.message_errors import MessageError
from rover_dashboard import conversions as shown
from rover_dashboard.node_heat_intake import heat_markers_of, heat_mission_of, sources_of

# Where NaN and infinities are values like any other.
NOT_FINITE = ("ranges", "celsius")

READERS: Mapping[type, tuple[Callable[[Any], Any], ...]] = {
    DriveCommand: (
        conversions.command_of,
        lambda m: encode_drive(conversions.command_of(m)[1]),
    ),
    Float32MultiArray: (lambda m: sensors.thermal_of(m, 0, 1),),
    HeatSourceArray: (sources_of,),
    HeatState: (heat_mission_of, shown.report_of),
    Image: (conversions.image_of, shown.picture_of),
    Imu: (sensors.imu_of,),
    LaserScan: (sensors.laser_scan_of, scan_conversions.scan_of),
    MarkerArray: (shown.markers_of, heat_markers_of),
    MissionState: (shown.mission_of, shown.report_of),
    OccupancyGrid: (conversions.grid_of, shown.map_of),
    Odometry: (conversions.pose_of, sensors.wheel_odometry_of),
    Path: (shown.plan_of,),
    PolarArray: (scan_conversions.polar_of,),
    PoseStamped: (transforms.pose_of_message,),
    RockTrackArray: (conversions.rocks_of,),
    RoverStatus: (conversions.run_of,),
    SensorTick: (sensors.tick_of,),
    TFMessage: (transforms.pose_of_transform,),
    TransformStamped: (transforms.pose_of_transform,),
    Twist: (sensors.twist_of,),
    TwistStamped: (lambda m: sensors.twist_of(m.twist),),
}


def read(message: Any) -> bool:
    """Whether it passes its check; then its conversions take it, and give finite numbers."""
    passed = True
    for part in parts_of(message):
        try:
            CHECKS[type(message)](part)
        except MessageError as error:
            assert str(error)
            passed = False
            continue
        for reader in READERS.get(type(message), ()):
            assert_finite(reader(part))
    return passed


def assert_finite(value: Any, name: str = "") -> None:
    """All numbers of a value of the cores, but for those that may be anything."""
    if name in NOT_FINITE:
        return
    if dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            assert_finite(getattr(value, field.name), field.name)
    elif isinstance(value, np.ndarray):
        assert np.isfinite(value).all(), name
    elif isinstance(value, list | tuple):
        for each in value:
            assert_finite(each, name)
    elif isinstance(value, dict):
        for key, each in value.items():
            assert_finite(each, str(key))
    elif isinstance(value, float):
        assert math.isfinite(value), name
