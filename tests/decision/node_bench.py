"""A decision node, its frames and maps by hand, and what it publishes."""

from __future__ import annotations

import math
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from frames_by_hand import frame, nanoseconds
from maps import UNKNOWN
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rover_interfaces.msg import (
    DriveCommand,
    MissionState,
    PolarArray,
    RockTrackArray,
    RoverStatus,
)
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Trigger

from rover_common import frames, topics
from rover_common.ros import conversions, qos, scan_conversions
from rover_common.types import FIRST_RUN, Command, Run
from rover_decision.node import DecisionNode
from rover_decision.types import Frame

PERIOD = 0.3  # [s] of frame time
PARTS = {
    topics.ODOMETRY: Odometry,
    topics.STATUS: RoverStatus,
    topics.NAV_POLAR: PolarArray,
    topics.ROCK_POLAR: PolarArray,
    topics.FREE_SCAN: LaserScan,
    topics.ROCKS: RockTrackArray,
}


class NodeBench:
    """The peer of the node on all of its topics and services."""

    def __init__(self, ros: Any, **parameters: Any) -> None:
        self.ros = ros
        self.node = ros.add(DecisionNode, **parameters)
        self.peer = ros.add(lambda **kwargs: Node("peer", **kwargs))
        self._parts = {
            topic: self.peer.create_publisher(kind, topic, qos.FRAME)
            for topic, kind in PARTS.items()
        }
        self._maps = self.peer.create_publisher(OccupancyGrid, topics.NAVIGATION_MAP, qos.LATCHED)
        self.commands: list[DriveCommand] = []
        self.states: list[MissionState] = []
        self.diagnostics: list[DiagnosticArray] = []
        listen = self.peer.create_subscription
        listen(DriveCommand, topics.COMMAND, self.commands.append, qos.FRAME)
        listen(MissionState, topics.MISSION_STATE, self.states.append, qos.LATCHED)
        listen(DiagnosticArray, "/diagnostics", self.diagnostics.append, qos.DIAGNOSTICS)
        self.run = FIRST_RUN
        self.time = 1.0  # [s] of the last frame
        assert ros.spin_until(lambda: self.node.count_subscribers(topics.COMMAND) > 0)
        for publisher in (*self._parts.values(), self._maps):
            assert ros.spin_until(lambda p=publisher: p.get_subscription_count() > 0)

    def begin_run(self) -> None:
        """The bridge begins a new run with the next frame."""
        self.run = Run(self.run.number + 1, nanoseconds(self.time) + 1)

    def send(self, after: float = PERIOD, map_age: float | None = None, **what: Any) -> Frame:
        """Publish a frame; it orders no plan unless it is told how old its map is."""
        self.time += after
        shown = frame(self.time, run=self.run, map_age=map_age or 0.0, **what)
        stamp, vehicle, run = shown.stamp, shown.vehicle, self.run
        status = RoverStatus(
            header=conversions.header_of(stamp, frames.BASE),
            run=run.number,
            run_start=conversions.time_of(run.start),
            near_sample=vehicle.near_sample,
            picking_up=vehicle.picking_up,
            sample_count=vehicle.sample_count,
            sim_time=math.nan,
        )
        map_stamp = stamp - 1 if map_age is None else shown.map_stamp
        messages = (
            conversions.odometry_of(stamp, vehicle.pose, vehicle.speed),
            status,
            scan_conversions.polar_message_of(stamp, run, shown.nav),
            scan_conversions.polar_message_of(stamp, run, shown.rock),
            scan_conversions.scan_message_of(stamp, shown.scan),
            conversions.rocks_message_of(stamp, run, shown.rocks, map_stamp),
        )
        for publisher, message in zip(self._parts.values(), messages, strict=True):
            publisher.publish(message)
        return shown

    def send_map(self, stamp: int) -> None:
        self._maps.publish(conversions.grid_message_of(stamp, UNKNOWN))

    def frame(self, **what: Any) -> Command:
        """Publish a frame and wait for the command that answers it."""
        answered = len(self.commands)
        shown = self.send(**what)
        assert self.ros.spin_until(lambda: len(self.commands) > answered)
        stamp, command = conversions.command_of(self.commands[-1])
        assert stamp == shown.stamp
        return command

    def call(self, name: str) -> Trigger.Response:
        client = self.peer.create_client(Trigger, f"decision_node/{name}")
        assert self.ros.spin_until(client.service_is_ready)
        future = client.call_async(Trigger.Request())
        assert self.ros.spin_until(future.done)
        return future.result()

    def reported(self, key: str) -> str:
        """The newest value of the node's diagnostics; empty before the first."""
        for message in reversed(self.diagnostics):
            for status in message.status:
                for pair in status.values:
                    if "decision" in status.name and pair.key == key:
                        return pair.value
        return ""
