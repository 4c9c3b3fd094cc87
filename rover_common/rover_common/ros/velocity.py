"""Velocities on cmd_vel, in the type that the robot takes."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Twist as TwistMsg
from geometry_msgs.msg import TwistStamped
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from rover_common import topics
from rover_common.frames import FRAMES, Frames
from rover_common.ros import qos
from rover_common.ros.sensor_conversions import stamped_twist_message_of, twist_message_of
from rover_common.sensor_types import Twist

KINDS = {"geometry_msgs/msg/TwistStamped": TwistStamped, "geometry_msgs/msg/Twist": TwistMsg}
LOOK = 0.5  # [s] of wall time between two looks at who subscribes


class VelocityPublisher:
    """A velocity of the wrong type is ignored without a word, so it looks who subscribes to what.

    It sends one type, for a participant of Fast DDS has one type on a topic: where both are taken,
    the one that it sends already, else the stamped one.
    """

    def __init__(
        self, node: Node, stamped: str, frames: Frames = FRAMES, topic: str = topics.CMD_VEL
    ) -> None:
        """stamped: auto (as the subscriber has it), true or false."""
        self._node, self._topic = node, topic
        self._frames = frames
        self._publisher: Any = None
        if stamped == "auto":
            clock = Clock(clock_type=ClockType.STEADY_TIME)
            self._timer = node.create_timer(LOOK, self._look, clock=clock)
            self._look()
        else:
            self._publish_as(TwistStamped if stamped == "true" else TwistMsg)

    @property
    def connected(self) -> bool:
        """Whether somebody takes it."""
        return self._publisher is not None and self._publisher.get_subscription_count() > 0

    def publish(self, stamp: int, twist: Twist) -> None:
        """stamp: [ns]. To nobody before somebody is there."""
        if self._publisher is None:
            return
        stamped = self._publisher.msg_type is TwistStamped
        message: Any = twist_message_of(twist)
        if stamped:
            message = stamped_twist_message_of(stamp, twist, self._frames)
        self._publisher.publish(message)

    def _look(self) -> None:
        infos = self._node.get_subscriptions_info_by_topic(self._topic)
        taken = {info.topic_type for info in infos}
        wanted = [kind for name, kind in KINDS.items() if name in taken]
        present = None if self._publisher is None else self._publisher.msg_type
        if wanted and present not in wanted:
            self._publish_as(wanted[0])

    def _publish_as(self, kind: type) -> None:
        if self._publisher is not None:
            self._node.destroy_publisher(self._publisher)
        self._publisher = self._node.create_publisher(kind, self._topic, qos.CONTROL)
        self._node.get_logger().info(f"{self._topic}: {kind.__name__}")
