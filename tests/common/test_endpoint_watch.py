"""Subscriptions that do not fit their publishers are told."""

from __future__ import annotations

from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu

from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.endpoint_watch import EndpointWatch

BEST_EFFORT = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)


class Watched(Node):
    """Wants odometry, reliable."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("watched", **kwargs)
        diagnostics = NodeDiagnostics(self, {})
        odometry = self.create_subscription(Odometry, topics.ODOMETRY, lambda _: None, qos.SENSOR)
        self.watch = EndpointWatch(self, diagnostics, [odometry])


def states(ros: Any) -> list[DiagnosticStatus]:
    heard: list[DiagnosticStatus] = []
    listener = ros.add(lambda **kwargs: Node("listener", **kwargs))

    def hear(message: DiagnosticArray) -> None:
        heard.extend(status for status in message.status if status.name == "/watched")

    listener.create_subscription(DiagnosticArray, "/diagnostics", hear, qos.DIAGNOSTICS)
    return heard


@pytest.mark.parametrize(
    ("kind", "profile", "says"),
    [
        (Odometry, BEST_EFFORT, "nothing of robot is received"),
        (Imu, qos.SENSOR, "robot sends sensor_msgs/msg/Imu, not nav_msgs/msg/Odometry"),
    ],
)
def test_what_cannot_be_received_is_an_error_in_the_diagnostics(
    ros, other_ros, kind, profile, says
):
    heard = states(ros)
    ros.add(Watched)
    robot = other_ros.add(lambda **kwargs: Node("robot", **kwargs))
    publisher = robot.create_publisher(kind, topics.ODOMETRY, profile)
    assert ros.spin_until(lambda: any(says in status.message for status in heard))
    assert heard[-1].level == DiagnosticStatus.ERROR
    robot.destroy_publisher(publisher)
    assert ros.spin_until(lambda: heard[-1].level == DiagnosticStatus.OK)


def test_what_fits_is_no_problem(ros):
    node = ros.add(Watched)
    robot = ros.add(lambda **kwargs: Node("robot", **kwargs))
    robot.create_publisher(Odometry, topics.ODOMETRY, qos.SENSOR)
    assert ros.spin_until(lambda: node.count_publishers(topics.ODOMETRY) > 0)
    assert node.watch.check() == []
