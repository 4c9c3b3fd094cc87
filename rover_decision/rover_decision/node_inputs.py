"""What the decision node hears, and of whom."""

from __future__ import annotations

import time
from collections.abc import Mapping

from rclpy.node import Node
from rclpy.subscription import Subscription

from rover_common import nodes, topics
from rover_common.input_monitor import Input, InputLimits, InputMonitor
from rover_common.ros.diagnostics import input_of
from rover_common.ros.parameters import declare_parameters

FRAMES = "frames"  # joined of the other inputs, and decided on
OF_BRIDGE = (topics.ODOMETRY, topics.STATUS)
MAP_PAUSE = 2.0  # [s] a navigation map is due with every few frames, and only while they change it


class DecisionInputs:
    """Declares InputLimits, and monitors all inputs on the steady clock."""

    def __init__(self, node: Node, subscriptions: Mapping[str, Subscription]) -> None:
        """subscriptions: by topic."""
        self.limits = declare_parameters(node, InputLimits)
        inputs = [
            input_of(
                topic,
                each,
                nodes.BRIDGE if topic in OF_BRIDGE else nodes.PERCEPTION,
                MAP_PAUSE if topic == topics.NAVIGATION_MAP else 0.0,
            )
            for topic, each in subscriptions.items()
        ]
        self.monitor = InputMonitor([*inputs, Input(FRAMES)], self.limits)
        self._incomplete = 0

    def note(self, name: str) -> None:
        """A message of this topic came, or a frame was decided on."""
        self.monitor.note(name, time.monotonic())

    def note_incomplete(self, count: int) -> None:
        """So many frames were incomplete since the start."""
        new, self._incomplete = count - self._incomplete, count
        if new:
            self.monitor.drop(FRAMES, time.monotonic(), "incomplete", new)
