"""Messages into slots and history, whether they come from the graph or from a recording.

Which robot is shown follows from what is heard: the state of the one mission or of the other.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import OccupancyGrid, Path
from rover_interfaces.msg import DriveCommand, MissionState
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from rover_common import topics
from rover_common.ros.conversions import command_of, stamp_of, vehicle_state_of
from rover_common.ros.sync import ExactTimeSynchronizer
from rover_dashboard.conversions import (
    COMPRESSED_VISION,
    DIAGNOSTICS,
    health_of,
    jpeg_of,
    map_of,
    markers_of,
    mission_of,
    picture_of,
    plan_of,
    report_of,
    vehicle_of,
)
from rover_dashboard.feed import OF_RUN, SLOTS, VIEWS
from rover_dashboard.history import History
from rover_dashboard.node_heat_intake import HeatIntake
from rover_dashboard.slots import Slots

ROVER, HEAT = "rover", "heat"
SPACING = 0.25  # [m] between two points of the rover's track
STAYS = ("playback", "robot", "simulator", "health")  # when another robot is shown


class Intake:
    """Takes one message of the topics in conversions.TYPES at a time."""

    def __init__(self, slots: Slots, history: History) -> None:
        self._slots = slots
        self._history = history
        self.robot = ""  # that is shown; none before a mission was heard of
        self._heat = HeatIntake(slots, history)
        self._sync = ExactTimeSynchronizer((topics.ODOMETRY, topics.STATUS))
        self._takers: dict[str, Callable[[Any], None]] = {
            topics.ODOMETRY: lambda message: self._take_part(topics.ODOMETRY, message),
            topics.STATUS: lambda message: self._take_part(topics.STATUS, message),
            topics.MISSION_STATE: self._take_mission,
            topics.BRIDGE_STATE: self._take_bridge,
            DIAGNOSTICS: self._take_diagnostics,
            topics.COMPRESSED_IMAGE: lambda message: self._take_jpeg("camera", message),
            topics.VISION_IMAGE: self._take_vision,
            COMPRESSED_VISION: lambda message: self._take_jpeg("vision", message),
            topics.WORLDMAP: self._take_map,
            topics.PLAN: self._take_plan,
            topics.MISSION_MARKERS: self._take_markers,
            topics.COMMAND: self._take_command,
        }

    def take(self, topic: str, message: Any) -> None:
        """topic: relative to the namespace. Raises MessageError for an image it cannot show."""
        if topic in (topics.MISSION_STATE, topics.HEAT_STATE):
            self._show(HEAT if topic == topics.HEAT_STATE else ROVER)
        if topic in self._heat.takers and (self.robot == HEAT or topic not in self._takers):
            self._heat.takers[topic](message)
        else:
            self._takers[topic](message)

    def _show(self, robot: str) -> None:
        """Nothing of another robot may stay."""
        if self.robot == robot:
            return
        if self.robot:
            self._history.restart()
            self._slots.empty(set(SLOTS) - set(STAYS))
        self.robot = robot
        self._slots.put("robot", robot)

    def stop_viewing(self) -> None:
        """Nobody looks: what is heard of only while somebody looks is no longer true."""
        self._slots.empty(VIEWS)
        self._heat.stop_viewing()
        self._history.stop_viewing()

    def _take_part(self, topic: str, message: Any) -> None:
        parts = self._sync.add(topic, stamp_of(message.header.stamp), message)
        if parts is None:
            return
        status = parts[topics.STATUS]
        vehicle = vehicle_state_of(parts[topics.ODOMETRY], status)
        readings = (round(math.degrees(status.steering_angle), 1),)
        if self._history.add_frame(vehicle, readings, SPACING):
            self._slots.empty(OF_RUN)
        self._slots.put("vehicle", vehicle_of(vehicle, status))

    def _take_mission(self, message: MissionState) -> None:
        self._history.add_state(report_of(message))
        self._slots.put("mission", mission_of(message))

    def _take_bridge(self, message: String) -> None:
        self._slots.put("simulator", message.data)

    def _take_diagnostics(self, message: DiagnosticArray) -> None:
        health, before = health_of(message), self._slots.get("health")
        if health is not None and (before is None or before.value != health):
            self._slots.put("health", health)

    def _take_jpeg(self, name: str, message: CompressedImage) -> None:
        self._slots.put(name, jpeg_of(message))

    def _take_vision(self, message: Image) -> None:
        self._slots.put("vision", picture_of(message))

    def _take_map(self, message: OccupancyGrid) -> None:
        stamped = map_of(message)
        self._history.add_map(stamped.stamp)
        self._slots.put("map", stamped)

    def _take_plan(self, message: Path) -> None:
        self._slots.put("plan", plan_of(message))

    def _take_markers(self, message: MarkerArray) -> None:
        self._slots.put("markers", markers_of(message))

    def _take_command(self, message: DriveCommand) -> None:
        self._history.add_command(command_of(message)[0])
