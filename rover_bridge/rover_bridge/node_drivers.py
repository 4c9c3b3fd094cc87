"""The drivers of the bridge: velocities beside the decision node, and who of them drives.

Subscribes cmd_vel_teleop and cmd_vel; publishes driver (latched).
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any

from geometry_msgs.msg import Twist as TwistMsg
from geometry_msgs.msg import TwistStamped
from rclpy.subscription import Subscription
from std_msgs.msg import String

from rover_bridge.arbiter import Arbiter, Driver
from rover_bridge.velocity_control import VelocityControl
from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.endpoint_watch import EndpointWatch
from rover_common.ros.sensor_conversions import twist_of
from rover_common.sensor_types import Twist
from rover_common.types import SAFE_COMMAND, Command, Telemetry

TOPICS = {Driver.MANUAL: topics.CMD_VEL_TELEOP, Driver.CMD_VEL: topics.CMD_VEL}


class DriverTopics:
    """Says what a telemetry is answered with at once; None leaves it to the decision node."""

    def __init__(
        self, node: CheckedNode, diagnostics: NodeDiagnostics, stamped: bool, command: Subscription
    ) -> None:
        """stamped: whether velocities are TwistStamped; command: the decision node's topic."""
        self._node = node
        self._decision = command
        self._arbiter = Arbiter()
        self._control = VelocityControl()
        self._time = -math.inf  # [s] of the newest telemetry
        self._driver = Driver.NOBODY
        self._publisher = node.create_publisher(String, topics.DRIVER, qos.LATCHED)
        kind = TwistStamped if stamped else TwistMsg
        self.subscriptions = [
            node.create_subscription(
                kind,
                topic,
                partial(self._on_velocity, driver),
                qos.CONTROL,
                refused=partial(self._on_refused, driver),
            )
            for driver, topic in TOPICS.items()
        ]
        self._watch = EndpointWatch(node, diagnostics, self.subscriptions)
        self._publish()

    def answer(self, stamp: int, telemetry: Telemetry) -> Command | None:
        """The command for the telemetry of this stamp [ns]; None: it waits for decision's."""
        self._time = stamp * 1e-9
        driver = self._arbiter.driver(self._time)
        self._note(driver)
        wanted = self._arbiter.velocity(driver)
        if wanted is not None:
            return self._control.command(stamp, telemetry.pose, telemetry.speed, wanted)
        if driver is Driver.NOBODY and self._velocities_only():
            return SAFE_COMMAND  # a navigator needs the odometry of a standing rover, too
        return None

    def hear_decision(self) -> None:
        """A command of the decision node has come."""
        self._arbiter.hear(Driver.DECISION, self._time)
        self._note(self._arbiter.driver(self._time))

    def _velocities_only(self) -> bool:
        """Whether a node may drive by velocities, and none as the decision node does."""
        velocities = any(each.get_publisher_count() for each in self.subscriptions)
        return velocities and not self._decision.get_publisher_count()

    def _on_velocity(self, driver: Driver, message: Any) -> None:
        wanted = twist_of(message.twist if isinstance(message, TwistStamped) else message)
        self._arbiter.hear(driver, self._time, wanted)

    def _on_refused(self, driver: Driver, _: Any) -> None:
        """A velocity that cannot be used is a brake."""
        self._arbiter.hear(driver, self._time, Twist())

    def _note(self, driver: Driver) -> None:
        if driver is not self._driver:
            self._driver = driver
            self._publish()
            self._node.get_logger().info(f"driver: {driver.value}")

    def _publish(self) -> None:
        self._publisher.publish(String(data=self._driver.value))
