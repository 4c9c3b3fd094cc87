"""How long commands take, as a node beside the graph hears them."""

from __future__ import annotations

import time

from nav_msgs.msg import Odometry
from rclpy.node import Node
from rover_interfaces.msg import DriveCommand

from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.conversions import command_of, stamp_of


class Latency:
    """From the odometry of a frame to its command, of the frames since `laps` was emptied."""

    def __init__(self, node: Node) -> None:
        self.laps: list[float] = []  # [ms]
        self.stamp = 0  # [ns] of the newest odometry
        self._arrived: dict[int, float] = {}
        node.create_subscription(Odometry, topics.ODOMETRY, self._on_odometry, qos.FRAME)
        node.create_subscription(DriveCommand, topics.COMMAND, self._on_command, qos.FRAME)

    def _on_odometry(self, message: Odometry) -> None:
        self.stamp = stamp_of(message.header.stamp)
        self._arrived = {self.stamp: time.monotonic()}

    def _on_command(self, message: DriveCommand) -> None:
        arrived = self._arrived.pop(command_of(message)[0], None)
        if arrived is not None:
            self.laps.append(1e3 * (time.monotonic() - arrived))
