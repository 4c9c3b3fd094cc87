"""What heat_node hears of its robot: batches of the sensors, transforms, the map."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from rover_interfaces.msg import SensorTick
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Float32MultiArray, String
from tf2_msgs.msg import TFMessage

from rover_common import nodes, topics
from rover_common.frames import Frames
from rover_common.input_monitor import InputLimits, InputMonitor
from rover_common.ros import qos
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.conversions import grid_of, map_begun_of, stamp_of
from rover_common.ros.diagnostics import input_of
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.transforms import pose_of_transform
from rover_common.sensor_batches import BatchCollector
from rover_common.types import GridMap
from rover_navigation.transform_buffer import TransformBuffer

# What has to come all the time, and for how long it is silent anyway [s].
PAUSES = {
    topics.SCAN: 0.0,
    topics.IMU: 0.0,
    topics.ODOMETRY: 0.0,
    topics.TEMPERATURE_1: 1.0,
    topics.TEMPERATURE_2: 1.0,
    topics.MAP: 5.0,
}


class HeatSensors:
    """Callbacks only store; `heard` is called after each of them."""

    def __init__(
        self, node: CheckedNode, lockstep: bool, frames: Frames, heard: Callable[[], None]
    ) -> None:
        self._node = node
        self._frames = frames
        self._heard = heard
        self.collector = BatchCollector()
        self.poses = TransformBuffer()
        self.grid: GridMap | None = None
        self.grid_stamp = 0  # [ns]
        self.map_begun = 0  # [ns] which tells its frame apart; 0 for unknown
        thermal = self._on_thermal
        listened: list[tuple[Any, str, Callable[[Any], None], Any]] = [
            (LaserScan, topics.SCAN, self._on_scan, qos.SCAN),
            (Imu, topics.IMU, lambda m: self.collector.add(sensors.imu_of(m)), qos.IMU),
            (Odometry, topics.ODOMETRY, self._on_odometry, qos.SENSOR),
            (Float32MultiArray, topics.TEMPERATURE_1, partial(thermal, 1), qos.SENSOR),
            (Float32MultiArray, topics.TEMPERATURE_2, partial(thermal, 2), qos.SENSOR),
            (String, topics.FLYWHEEL_STATUS, lambda _: self.collector.add_launch(), qos.CONTROL),
            (OccupancyGrid, topics.MAP, self._on_map, qos.LATCHED),
            (TFMessage, "/tf", self._on_transform, qos.TF),
        ]
        if lockstep:
            listened.append((SensorTick, topics.SENSOR_TICK, self._on_tick, qos.SENSOR))
        node.expect_frames({topics.MAP: frames.map})
        self.subscriptions = [
            node.create_subscription(kind, topic, partial(self._store, topic, callback), profile)
            for kind, topic, callback, profile in listened
        ]
        by_topic = dict(zip((row[1] for row in listened), self.subscriptions, strict=True))
        self.limits = declare_parameters(node, InputLimits)
        self.inputs = InputMonitor(
            (
                input_of(
                    topic,
                    by_topic[topic],
                    nodes.NAVIGATOR if topic == topics.MAP else nodes.BURGER,
                    pause,
                )
                for topic, pause in PAUSES.items()
            ),
            # In lockstep time passes as fast as the nodes answer.
            replace(self.limits, input_min_rate=0.0) if lockstep else self.limits,
        )

    @property
    def dropped(self) -> int:
        """Thermal frames that are none."""
        begin = (f"refused_{topics.TEMPERATURE_1}", f"refused_{topics.TEMPERATURE_2}")
        return sum(n for key, n in self._node.counts.items() if key.startswith(begin))

    def _store(self, topic: str, callback: Callable[[Any], None], message: Any) -> None:
        if topic in PAUSES:
            self.inputs.note(topic, time.monotonic())
        callback(message)
        self._heard()

    def _on_scan(self, message: LaserScan) -> None:
        self.collector.add(sensors.laser_scan_of(message))

    def _on_odometry(self, message: Odometry) -> None:
        self.collector.add(sensors.wheel_odometry_of(message))

    def _on_thermal(self, sensor: int, message: Float32MultiArray) -> None:
        """It has no stamp: it counts as arrived now."""
        now = self._node.get_clock().now().nanoseconds
        self.collector.add(sensors.thermal_of(message, now, sensor))

    def _on_map(self, message: OccupancyGrid) -> None:
        self.grid, self.grid_stamp = grid_of(message), stamp_of(message.header.stamp)
        self.map_begun = map_begun_of(message)

    def _on_transform(self, link: TransformStamped) -> None:
        frames, stamp = self._frames, stamp_of(link.header.stamp)
        parent, child = link.header.frame_id, link.child_frame_id
        if (parent, child) == (frames.map, frames.odom):
            self.poses.add_correction(stamp, pose_of_transform(link))
        elif parent == frames.odom and child in (frames.footprint, frames.base):
            self.poses.add_odometry(stamp, pose_of_transform(link))  # robots place either in odom

    def _on_tick(self, message: SensorTick) -> None:
        self.collector.add_tick(sensors.tick_of(message))
