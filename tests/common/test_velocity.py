"""Velocities in the type that the robot's driver takes."""

from __future__ import annotations

from typing import Any

import pytest
from geometry_msgs.msg import Twist as TwistMsg
from geometry_msgs.msg import TwistStamped
from rclpy.node import Node

from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.velocity import VelocityPublisher
from rover_common.sensor_types import Twist

KINDS = pytest.mark.parametrize("kind", [TwistMsg, TwistStamped])


def node(ros: Any, name: str) -> Node:
    return ros.add(lambda **kwargs: Node(name, **kwargs))


def listen(ros: Any, kind: type) -> tuple[Node, list[Any]]:
    heard: list[Any] = []
    robot = node(ros, "robot")
    robot.create_subscription(kind, topics.CMD_VEL, heard.append, qos.CONTROL)
    return robot, heard


@KINDS
def test_it_sends_the_type_that_a_robot_has_that_comes_later(ros, kind):
    velocity = VelocityPublisher(node(ros, "driver"), "auto")
    velocity.publish(1, Twist(0.1, 0.2))  # to nobody
    assert not velocity.connected
    _, heard = listen(ros, kind)
    assert ros.spin_until(lambda: velocity.connected)
    velocity.publish(5, Twist(0.1, 0.2))
    assert ros.spin_until(lambda: heard)
    twist = heard[0].twist if kind is TwistStamped else heard[0]
    assert (twist.linear.x, twist.angular.z) == (0.1, 0.2)
    if kind is TwistStamped:
        assert heard[0].header.stamp.nanosec == 5


@KINDS
def test_it_follows_a_robot_that_comes_back_with_the_other_type(ros, other_ros, kind):
    velocity = VelocityPublisher(node(ros, "driver"), "auto")
    robot, _ = listen(other_ros, kind)
    assert ros.spin_until(lambda: velocity.connected)
    robot.destroy_subscription(next(robot.subscriptions))
    _, heard = listen(other_ros, TwistMsg if kind is TwistStamped else TwistStamped)
    assert ros.spin_until(lambda: velocity._publisher.msg_type is not kind and velocity.connected)
    velocity.publish(5, Twist(0.1, 0.0))
    assert other_ros.spin_until(lambda: heard)


def test_a_second_subscriber_with_another_type_changes_nothing(ros, other_ros):
    velocity = VelocityPublisher(node(ros, "driver"), "auto")
    _, heard = listen(ros, TwistMsg)
    assert ros.spin_until(lambda: velocity.connected)
    listen(other_ros, TwistStamped)
    assert not ros.spin_until(lambda: not velocity.connected, timeout=1.2)
    velocity.publish(5, Twist(0.1, 0.0))
    assert ros.spin_until(lambda: heard)


@pytest.mark.parametrize(("stamped", "kind"), [("true", TwistStamped), ("false", TwistMsg)])
def test_the_type_can_be_told(ros, stamped, kind):
    velocity = VelocityPublisher(node(ros, "driver"), stamped)
    _, heard = listen(ros, kind)
    assert ros.spin_until(lambda: velocity.connected)
    velocity.publish(5, Twist(0.1, 0.0))
    assert ros.spin_until(lambda: heard)
