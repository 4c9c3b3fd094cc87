"""Messages to what the page shows, as values of JSON.

Positions are [m] in the map frame, rounded to a centimetre.
"""

from __future__ import annotations

import math
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.serialization import deserialize_message
from rover_interfaces.msg import (
    DriveCommand,
    HeatSourceArray,
    HeatState,
    MissionState,
    RoverStatus,
)
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Float32MultiArray, String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from rover_common import topics
from rover_common.ros.conversions import grid_of, image_of, stamp_of
from rover_common.ros.diagnostics import TEAM_STATUS
from rover_common.types import VehicleState
from rover_dashboard.encoders import Jpeg, Picture, StampedMap
from rover_dashboard.history import StateReport

Point = tuple[float, float]
COMPRESSED_VISION = f"{topics.VISION_IMAGE}/compressed"  # in recordings
TF, DIAGNOSTICS = "/tf", "/diagnostics"  # in no namespace


TYPES: dict[str, type] = {
    topics.ODOMETRY: Odometry,
    topics.STATUS: RoverStatus,
    topics.MISSION_STATE: MissionState,
    topics.BRIDGE_STATE: String,
    topics.COMMAND: DriveCommand,
    topics.COMPRESSED_IMAGE: CompressedImage,
    topics.VISION_IMAGE: Image,
    COMPRESSED_VISION: CompressedImage,
    topics.WORLDMAP: OccupancyGrid,
    topics.PLAN: Path,
    topics.MISSION_MARKERS: MarkerArray,
    topics.HEAT_STATE: HeatState,
    topics.HEAT_SOURCES: HeatSourceArray,
    topics.HEAT_MARKERS: MarkerArray,
    topics.MAP: OccupancyGrid,
    topics.TEMPERATURE_1: Float32MultiArray,
    topics.TEMPERATURE_2: Float32MultiArray,
    TF: TFMessage,
}


def decoded(topic: str, data: bytes) -> Any:
    """A message of one of the topics in TYPES from its CDR bytes."""
    return deserialize_message(data, TYPES[topic])


def picture_of(message: Image) -> Picture:
    """Raises MessageError."""
    return Picture(stamp_of(message.header.stamp), image_of(message))


def jpeg_of(message: CompressedImage) -> Jpeg:
    return Jpeg(stamp_of(message.header.stamp), message.data.tobytes())


def map_of(message: OccupancyGrid) -> StampedMap:
    return StampedMap(stamp_of(message.header.stamp), grid_of(message))


def health_of(message: DiagnosticArray) -> dict[str, Any] | None:
    """Level and cause of the whole graph, if this message tells them."""
    for status in message.status:
        if status.name.rsplit("/", 1)[-1] == TEAM_STATUS:
            return {"level": status.level[0], "text": status.message}
    return None


def vehicle_of(vehicle: VehicleState, status: RoverStatus) -> dict[str, Any]:
    """Where the rover is and what its wheels and its arm do; angles in degrees."""
    return {
        "stamp": vehicle.stamp * 1e-9,
        "x": round(vehicle.pose.x, 2),
        "y": round(vehicle.pose.y, 2),
        "yaw": round(math.degrees(vehicle.pose.yaw), 1),
        "speed": round(vehicle.speed, 2),
        "steering": round(math.degrees(status.steering_angle), 1),
        "throttle": round(status.throttle, 2),
        "brake": round(status.brake, 2),
        "arm": "picking up" if vehicle.picking_up else "in reach" if vehicle.near_sample else "",
    }


def mission_of(message: MissionState) -> dict[str, Any]:
    return {
        "stamp": stamp_of(message.header.stamp) * 1e-9,
        "run": message.run,
        "state": message.state_name,
        "reason": message.reason,
        "elapsed": round(message.elapsed, 1),
        "explored": round(message.explored, 4),
        "samples_total": message.samples_total,
        "samples_collected": message.samples_collected,
        "rocks_known": message.rocks_known,
        "rocks_given_up": message.rocks_given_up,
        "home_distance": round(message.home_distance, 1),
        "distance": round(message.distance, 1),
        "recoveries": message.recoveries,
    }


def report_of(message: MissionState | HeatState) -> StateReport:
    stamp = stamp_of(message.header.stamp)
    return StateReport(stamp, message.run, message.state_name, message.reason)


def plan_of(message: Path) -> list[Point]:
    return [point_of(pose.pose.position) for pose in message.poses]


def markers_of(message: MarkerArray) -> dict[str, list[Point]]:
    """Points by the markers' namespaces; those that were deleted are empty."""
    return {
        marker.ns: [point_of(point) for point in marker.points]
        if marker.action == Marker.ADD
        else []
        for marker in message.markers
    }


def point_of(position: Any) -> Point:
    return (round(position.x, 2), round(position.y, 2))
