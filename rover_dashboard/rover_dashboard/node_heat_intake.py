"""Messages of the second robot and of its mission into slots and history."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from rover_interfaces.msg import HeatSourceArray, HeatState
from std_msgs.msg import Float32MultiArray
from visualization_msgs.msg import Marker, MarkerArray

from rover_common import topics
from rover_common.frames import MAP, ODOM, bare
from rover_common.geometry import Pose, compose, compose_points
from rover_common.ros.conversions import pose_of, stamp_of
from rover_common.ros.transforms import pose_of_transform
from rover_common.types import Run, VehicleState
from rover_dashboard.conversions import TF, Point, map_of, point_of, report_of
from rover_dashboard.encoders import Picture
from rover_dashboard.feed import OF_RUN
from rover_dashboard.history import History
from rover_dashboard.slots import Slots
from rover_heat.thermal.picture import excess_of, picture_of

SPACING = 0.03  # [m] between two points of the track
SAME_START = 0.5  # [s] two states of one run agree on its start
CORNERS = 24  # of a disc's outline


class HeatIntake:
    """Takes one message of its topics at a time."""

    def __init__(self, slots: Slots, history: History) -> None:
        self._slots = slots
        self._history = history
        self._run: Run | None = None
        self._correction: Pose | None = None  # of odom in the map
        self._excess: list[float | None] = [None, None]  # [K] of each thermal sensor
        self.takers: dict[str, Callable[[Any], None]] = {
            topics.HEAT_STATE: self._take_state,
            topics.ODOMETRY: self._take_odometry,
            TF: self._take_transform,
            topics.MAP: self._take_map,
            topics.HEAT_MARKERS: self._take_markers,
            topics.HEAT_SOURCES: self._take_sources,
            topics.TEMPERATURE_1: partial(self._take_temperatures, 1),
            topics.TEMPERATURE_2: partial(self._take_temperatures, 2),
        }

    def stop_viewing(self) -> None:
        """Nobody looks: thermal frames are no longer heard of."""
        self._excess = [None, None]

    def _take_state(self, message: HeatState) -> None:
        start = stamp_of(message.header.stamp) - round(message.elapsed * 1e9)
        known = self._run
        same = known is not None and known.number == message.run
        if known is None or not same or abs(start - known.start) > SAME_START * 1e9:
            self._run = Run(message.run, start)
        self._history.add_state(report_of(message))
        self._slots.put("mission", heat_mission_of(message))

    def _take_odometry(self, message: Odometry) -> None:
        if self._run is None or self._correction is None:
            return
        stamp, twist = stamp_of(message.header.stamp), message.twist.twist
        pose = compose(self._correction, pose_of(message))
        vehicle = VehicleState(stamp, pose, twist.linear.x, False, False, 0, self._run)
        turn = round(math.degrees(twist.angular.z), 1)
        if self._history.add_frame(vehicle, (turn, *self._excess), SPACING):
            self._slots.empty(OF_RUN)
        self._slots.put(
            "vehicle",
            {
                "stamp": stamp * 1e-9,
                "x": round(pose.x, 3),
                "y": round(pose.y, 3),
                "yaw": round(math.degrees(pose.yaw), 1),
                "speed": round(twist.linear.x, 2),
                "turn": turn,
            },
        )

    def _take_transform(self, link: TransformStamped) -> None:
        if (bare(link.header.frame_id), bare(link.child_frame_id)) == (MAP, ODOM):
            self._correction = pose_of_transform(link)

    def _take_map(self, message: OccupancyGrid) -> None:
        stamped = map_of(message)
        self._history.add_map(stamped.stamp)
        self._slots.put("map", stamped)

    def _take_markers(self, message: MarkerArray) -> None:
        self._slots.put("markers", heat_markers_of(message))

    def _take_sources(self, message: HeatSourceArray) -> None:
        self._slots.put("sources", sources_of(message))

    def _take_temperatures(self, sensor: int, message: Float32MultiArray) -> None:
        celsius = np.array(message.data, np.float32).reshape(8, 8)
        warmest = float(excess_of(celsius).max())
        self._excess[sensor - 1] = round(warmest, 2) if math.isfinite(warmest) else None
        self._slots.put(f"thermal_{sensor}", Picture(0, picture_of(celsius)))


def heat_mission_of(message: HeatState) -> dict[str, Any]:
    return {
        "stamp": stamp_of(message.header.stamp) * 1e-9,
        "run": message.run,
        "state": message.state_name,
        "reason": message.reason,
        "elapsed": round(message.elapsed, 1),
        "explored": round(message.explored, 4),
        "sources_known": message.sources_known,
        "sources_delivered": message.sources_delivered,
        "payloads": message.payloads,
        "interrupts": message.interrupts,
        "ramp": "done" if message.ramp_done else "known" if message.ramp_known else "not found",
        "distance": round(message.distance, 1),
    }


def sources_of(message: HeatSourceArray) -> list[dict[str, Any]]:
    return [
        {
            "id": source.id,
            "x": round(source.position.x, 3),
            "y": round(source.position.y, 3),
            "observations": source.observations,
            "peak": round(source.peak, 1),
            "delivered": source.delivered,
        }
        for source in message.sources
    ]


def heat_markers_of(message: MarkerArray) -> dict[str, list[Any]]:
    """Points by the markers' namespaces; of what is blocked, outlines of points."""
    found: dict[str, list[Any]] = {"outlines": []}
    for marker in message.markers:
        if marker.ns == "blocked" and marker.action == Marker.ADD:
            found["outlines"].append(_outline(marker))
        elif marker.points:
            found[marker.ns] = [point_of(point) for point in marker.points]
    return found


def _outline(marker: Marker) -> list[Point]:
    """Of a box or of a disc, as it lies on the ground."""
    at, turn = marker.pose.position, marker.pose.orientation
    half = 0.5 * np.array([marker.scale.x, marker.scale.y])
    if marker.type == Marker.CUBE:
        corners = half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    else:
        angles = np.linspace(0.0, 2.0 * math.pi, CORNERS, endpoint=False)
        corners = half * np.column_stack([np.cos(angles), np.sin(angles)])
    frame = Pose(at.x, at.y, 2.0 * math.atan2(turn.z, turn.w))
    return [(round(x, 3), round(y, 3)) for x, y in compose_points(frame, corners).tolist()]
