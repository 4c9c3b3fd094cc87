"""The navigator node: drives the second robot to poses of a map that it makes itself.

Subscribes scan, imu, odom, hazard_map (latched), /tf and /diagnostics, in lockstep sensor_tick.
Publishes map (latched), /tf (map -> odom), plan (while subscribed), cmd_vel (while it has a goal),
/diagnostics, in lockstep navigation_tick. Serves the action navigate_to_pose
(nav2_msgs/NavigateToPose), as Nav2 does. Parameters: NavigatorNodeConfig, InputLimits.
"""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Any

import numpy as np
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rover_interfaces.msg import NavigationTick, SensorTick
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage

from rover_common import nodes, topics
from rover_common.burger import BURGER
from rover_common.frames import BurgerFrameConfig
from rover_common.input_monitor import InputLimits, InputMonitor
from rover_common.ros import qos
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.conversions import grid_message_of, grid_of, stamp_of
from rover_common.ros.diagnostics import NodeDiagnostics, input_of
from rover_common.ros.endpoint_watch import EndpointWatch
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.ros.transforms import transform_message_of
from rover_common.ros.velocity import VelocityPublisher
from rover_common.sensor_batches import BatchCollector
from rover_common.sensor_types import SensorBatch, Twist, WheelOdometry
from rover_navigation.burger_scale import BURGER_SCALE
from rover_navigation.conversions import path_of, tick_message_of
from rover_navigation.embedded_navigator import EmbeddedNavigator, NavigatorOutput
from rover_navigation.node_action import NavigateServer
from rover_navigation.node_config import NavigatorNodeConfig
from rover_navigation.node_state import KeptNavigator
from rover_navigation.types import NO_POINTS

PERIOD = 0.05  # [s] between two steps
NOBODY_ELSE = 2_000_000_000  # [ns] of odometry without odom -> base_footprint by the robot


class NavigatorNode(CheckedNode):
    """Collects what the sensors say, steps the navigator, publishes what it says."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("navigator_node", **kwargs)
        self._frames = declare_parameters(self, BurgerFrameConfig).frames()
        self._config = config = declare_parameters(self, NavigatorNodeConfig)
        self._navigator = EmbeddedNavigator(BURGER, BURGER_SCALE, config, config.seed)
        self._kept = KeptNavigator(self, config.state_dir, self._navigator)
        self._collector = BatchCollector()
        self._hazards = 0  # [ns] stamp of the newest hazard map
        self._drove = False  # at the step before
        self._path = NO_POINTS  # that was shown last
        self._last: NavigatorOutput | None = None
        self._robot_sends_odometry = False
        self._first_odometry: int | None = None  # [ns]
        self._map = self.create_publisher(OccupancyGrid, topics.MAP, qos.LATCHED)
        self._plan = self.create_publisher(Path, topics.PLAN, qos.VIEW)
        self._tf = self.create_publisher(TFMessage, "/tf", qos.TF)
        self._tick = self.create_publisher(NavigationTick, topics.NAVIGATION_TICK, qos.SENSOR)
        self._velocity = VelocityPublisher(self, config.stamped_cmd_vel, self._frames)
        tolerance = config.goal_tolerance
        self._server = NavigateServer(self, self._navigator, tolerance, self._frames)
        subscriptions = self._subscribe()
        scan, imu, odometry = subscriptions[:3]
        limits = declare_parameters(self, InputLimits)
        sensors = {topics.SCAN: scan, topics.IMU: imu, topics.ODOMETRY: odometry}
        self._inputs = InputMonitor(
            (input_of(topic, each, nodes.BURGER) for topic, each in sensors.items()),
            replace(limits, input_min_rate=0.0) if config.lockstep else limits,
        )
        self._diagnostics = NodeDiagnostics(
            self,
            {
                "scan": lambda: scan.get_publisher_count() > 0,
                "odometry": lambda: odometry.get_publisher_count() > 0,
                "robot": lambda: self._velocity.connected,
            },
            self._inputs,
        )
        self._diagnostics.join(nodes.HEAT_TEAM, limits.input_error_age)
        self._watch = EndpointWatch(self, self._diagnostics, subscriptions)
        if not config.lockstep:
            self._timer = self.create_timer(PERIOD, self._on_timer)

    def _subscribe(self) -> list[Any]:
        subscribe = self.create_subscription
        self.expect_frames({topics.HAZARD_MAP: self._frames.map})
        subscriptions = [
            subscribe(LaserScan, topics.SCAN, self._on_scan, qos.SCAN),
            subscribe(Imu, topics.IMU, self._on_imu, qos.IMU),
            subscribe(Odometry, topics.ODOMETRY, self._on_odometry, qos.SENSOR),
            subscribe(OccupancyGrid, topics.HAZARD_MAP, self._on_hazards, qos.LATCHED),
            subscribe(TFMessage, "/tf", self._on_transform, qos.TF),
        ]
        if self._config.lockstep:
            on_tick = self._on_sensor_tick
            subscriptions.append(subscribe(SensorTick, topics.SENSOR_TICK, on_tick, qos.SENSOR))
        return subscriptions

    def destroy_node(self) -> None:
        """End the action's goal, save the last state, then end the node."""
        if hasattr(self, "_server"):
            self._server.destroy()
        if hasattr(self, "_kept"):
            self._kept.close()
        super().destroy_node()

    def _on_scan(self, message: LaserScan) -> None:
        self._inputs.note(topics.SCAN, time.monotonic())
        self._collector.add(sensors.laser_scan_of(message))
        self._step_when_complete()

    def _on_imu(self, message: Imu) -> None:
        self._inputs.note(topics.IMU, time.monotonic())
        self._collector.add(sensors.imu_of(message))
        self._step_when_complete()

    def _on_odometry(self, message: Odometry) -> None:
        self._inputs.note(topics.ODOMETRY, time.monotonic())
        self._collector.add(sensors.wheel_odometry_of(message))
        self._step_when_complete()

    def _on_sensor_tick(self, message: SensorTick) -> None:
        others = {"thermal": (0, 0), "launches": 0}  # which do not come here
        self._collector.add_tick(replace(sensors.tick_of(message), **others))  # type: ignore[arg-type]
        self._step_when_complete()

    def _on_hazards(self, message: OccupancyGrid) -> None:
        self._navigator.set_hazards(grid_of(message))
        self._hazards = stamp_of(message.header.stamp)
        if self._last is not None:
            self._answer(self._last)

    def _on_transform(self, link: TransformStamped) -> None:
        """Whether the robot sends its odometry's transform; what this node sends comes here too."""
        if self._config.odometry_transform == "auto" and not self._sends_odometry:
            self._robot_sends_odometry |= link.header.frame_id == self._frames.odom

    def _on_timer(self) -> None:
        self._step(self._collector.take(self.get_clock().now().nanoseconds))

    def _step_when_complete(self) -> None:
        if self._config.lockstep and (batch := self._collector.take_complete()) is not None:
            self._step(batch)

    def _step(self, batch: SensorBatch) -> None:
        self._kept.resume(batch)
        with self._diagnostics.ticks:
            output = self._navigator.step(batch)
        self._last = output
        self._send_transforms(batch.odometry, output)
        if output.map is not None:
            begun = self._navigator.map_begun
            self._map.publish(grid_message_of(output.stamp, output.map, self._frames, begun))
        if output.twist is not None:
            self._velocity.publish(output.stamp, output.twist)
        elif self._drove and not self._config.lockstep:  # there the mission answers without a goal
            self._velocity.publish(output.stamp, Twist())
        self._drove = output.twist is not None
        self._server.report(output)
        self._show(output)
        counts = self._diagnostics.counts
        counts["steps"] += 1
        counts["relocations"] = output.relocations
        self._diagnostics.set_warning("navigator", "" if self._navigator.is_ready else output.why)
        self._answer(output)
        self._kept.keep()

    def _send_transforms(
        self, odometry: tuple[WheelOdometry, ...], output: NavigatorOutput
    ) -> None:
        links, frames = [], self._frames
        if odometry and self._first_odometry is None:
            self._first_odometry = odometry[0].stamp
        if self._sends_odometry:
            links = [
                transform_message_of(each.stamp, frames.odom, frames.footprint, each.pose)
                for each in odometry
            ]
        if output.map_to_odom is not None:
            correction = output.map_to_odom
            links.append(transform_message_of(output.stamp, frames.map, frames.odom, correction))
        if links:
            self._tf.publish(TFMessage(transforms=links))

    @property
    def _sends_odometry(self) -> bool:
        """Whether odom -> base_footprint is for this node to send."""
        if self._config.odometry_transform != "auto":
            return self._config.odometry_transform == "true"
        first, last = self._first_odometry, self._last
        if self._robot_sends_odometry or first is None or last is None:
            return False
        return last.stamp - first > NOBODY_ELSE

    def _show(self, output: NavigatorOutput) -> None:
        """The path, when it is another one and somebody looks; an empty one takes it away."""
        if self._plan.get_subscription_count() == 0 or np.array_equal(output.path, self._path):
            return
        self._path = output.path
        self._plan.publish(path_of(output.stamp, output.path, self._frames))

    def _answer(self, output: NavigatorOutput) -> None:
        if self._config.lockstep:
            self._tick.publish(tick_message_of(output, self._hazards, self._frames))


def main() -> None:
    """Entry point of `ros2 run rover_navigation navigator_node`."""
    run_node(NavigatorNode, keeps_maps=True)
