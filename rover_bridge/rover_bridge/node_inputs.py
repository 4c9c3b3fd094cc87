"""What comes from the simulator and from decision, and when it is expected."""

from __future__ import annotations

from rclpy.node import Node
from rclpy.subscription import Subscription

from rover_common import nodes, topics
from rover_common.input_monitor import Input, InputLimits, InputMonitor
from rover_common.ros.diagnostics import input_of
from rover_common.ros.parameters import declare_parameters

TELEMETRY, SIMULATOR = "telemetry", "simulator"


class BridgeInputs:
    """Times are [s] of the steady clock."""

    def __init__(self, node: Node, command: Subscription) -> None:
        """Declares InputLimits; command: the subscription of what decision answers."""
        self.limits = declare_parameters(node, InputLimits)
        inputs = (
            Input(TELEMETRY, SIMULATOR),
            input_of(topics.COMMAND, command, nodes.DECISION),
        )
        self.monitor = InputMonitor(inputs, self.limits)

    def note_telemetry(self, now: float) -> None:
        self.monitor.note(TELEMETRY, now)

    def drop_telemetry(self, now: float, why: str) -> None:
        self.monitor.drop(TELEMETRY, now, why)

    def note_command(self, now: float) -> None:
        """A command came in time."""
        self.monitor.note(topics.COMMAND, now)

    def drop_command(self, now: float) -> None:
        """A telemetry was answered with the brake, because no command came."""
        self.monitor.drop(topics.COMMAND, now, "no decision in time")

    def expect(self, now: float, connected: bool, owes: bool) -> None:
        """A simulator sends when it is answered (owes), and is commanded when it sends."""
        refused = not connected and self.monitor.dropping(TELEMETRY, now)
        if not (connected and owes) and not refused:
            self.monitor.hold(TELEMETRY, now)
        if not connected or self.monitor.silent(TELEMETRY, now):
            self.monitor.hold(topics.COMMAND, now)
