"""What the second robot and its mission say, made up."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from geometry_msgs.msg import Point
from nav_msgs.msg import OccupancyGrid, Odometry
from rover_interfaces.msg import HeatSource, HeatSourceArray, HeatState
from std_msgs.msg import Float32MultiArray
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from rover_common import frames
from rover_common.geometry import Pose
from rover_common.ros.conversions import grid_message_of, header_of
from rover_common.ros.sensor_conversions import (
    thermal_message_of,
    wheel_odometry_message_of,
)
from rover_common.ros.transforms import transform_message_of
from rover_common.sensor_types import ThermalFrame, Twist, WheelOdometry
from rover_common.types import GridMap

SECOND = 1_000_000_000
START = SECOND  # [ns] stamp of the mission's first tick
CORRECTION = Pose(1.0, 0.0, math.pi / 2)  # of odom in the map


def state(second: float, name: str = "EXPLORING", run: int = 1, **changes: Any) -> HeatState:
    values = {"sources_known": 2, "payloads": 3, "explored": 0.5, "reason": "why"}
    return HeatState(
        header=header_of(START + round(second * SECOND), frames.MAP), state_name=name, run=run,
        elapsed=second, **values | changes,
    )  # fmt: skip


def odometry(second: float, x: float) -> Odometry:
    """Driving along odom's x axis, turning left."""
    stamp = START + round(second * SECOND)
    return wheel_odometry_message_of(WheelOdometry(stamp, Pose(x, 0.0, 0.0), Twist(0.2, 0.1)))


def transforms(second: float = 0.0, pose: Pose = CORRECTION) -> TFMessage:
    stamp = START + round(second * SECOND)
    body = transform_message_of(stamp, frames.ODOM, frames.BASE_FOOTPRINT, Pose(9.0, 9.0, 0.0))
    return TFMessage(transforms=[body, transform_message_of(stamp, frames.MAP, frames.ODOM, pose)])


def thermal(warm: float = 29.0) -> Float32MultiArray:
    """One pixel of a frame of 23 C."""
    celsius = np.full((8, 8), 23.0, np.float32)
    celsius[2, 5] = warm
    return thermal_message_of(ThermalFrame(0, 1, celsius))


def small_map(second: float = 0.0) -> OccupancyGrid:
    cells = np.full((40, 40), -1, np.int8)
    cells[10:30, 10:30] = 0
    grid = GridMap(0.05, -1.0, -1.0, cells)
    return grid_message_of(START + round(second * SECOND), grid)


def sources() -> HeatSourceArray:
    source = HeatSource(
        id=1, position=Point(x=1.0, y=2.0, z=0.0), observations=25, peak=6.04, delivered=True
    )
    return HeatSourceArray(sources=[source])


def markers() -> MarkerArray:
    """A strip along y, a disc, a goal, and two faces."""
    strip = Marker(ns="blocked", type=Marker.CUBE, action=Marker.ADD)
    strip.pose.position.x = 2.0
    strip.pose.orientation.z = strip.pose.orientation.w = math.sqrt(0.5)
    strip.scale.x, strip.scale.y = 1.25, 0.5
    disc = Marker(ns="blocked", type=Marker.CYLINDER, action=Marker.ADD, id=1)
    disc.scale.x = disc.scale.y = 0.4
    goal = Marker(ns="goal", action=Marker.ADD, points=[Point(x=1.0, y=1.0)])
    faces = Marker(ns="examined", action=Marker.ADD, points=[Point(), Point(x=0.05)])
    return MarkerArray(markers=[Marker(action=Marker.DELETEALL), strip, disc, goal, faces])
