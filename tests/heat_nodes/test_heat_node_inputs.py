"""heat_node and what does not fit: clocks, sizes, types of velocity, qualities of service."""

from __future__ import annotations

from functools import partial
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Twist as TwistMsg
from geometry_msgs.msg import TwistStamped
from heat_bench import ROOM, HeatBench, Robot
from mapped_rooms import map_of
from rcl_interfaces.msg import Log
from rclpy.logging import LoggingSeverity
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

from rover_common.ros import qos
from rover_common.ros.sensor_conversions import twist_of
from rover_common.sensor_types import Twist
from rover_heat.node import HeatNode
from rover_navigation.node import NavigatorNode

BEST_EFFORT = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
ERROR = int(LoggingSeverity.ERROR)
APART = 800_000_000  # [ns]


@pytest.fixture
def bench(ros) -> HeatBench:
    """It explores."""
    bench = HeatBench(ros)
    bench.robot.send_map(map_of(ROOM, [(1.5, 1.5)]))
    bench.until(lambda: bench.server.goals, 8.0)
    return bench


@pytest.mark.parametrize("ahead", [APART, -APART], ids=["ahead", "behind"])
def test_a_robot_whose_clock_is_apart_is_stopped_after_a_second_with_that_reason(bench, ahead):
    bench.robot.shift = ahead
    bench.seconds(0.8)
    assert bench.state == "EXPLORING"
    bench.until(lambda: bench.state == "HOLD", 1.0)
    bench.until(lambda: "clock" in bench.reason, 0.2)
    bench.until(lambda: bench.server.canceled == 1, 0.3)
    assert twist_of(bench.velocities[-1].twist) == Twist()


def test_it_goes_on_when_the_clocks_agree_again(bench):
    bench.robot.shift = -APART
    bench.until(lambda: bench.state == "HOLD", 2.0)
    bench.robot.shift = 0
    bench.until(lambda: bench.state == "EXPLORING", 3.0)
    bench.until(lambda: bench.server.active, 3.0)


def test_a_thermal_frame_of_another_size_is_dropped_and_counted_and_the_mission_goes_on(bench):
    counts = bench.node._diagnostics.counts
    assert counts["thermal_dropped"] == 0
    bench.robot.pixels = 63
    bench.seconds(1.0)
    assert 30 <= counts["thermal_dropped"] <= 40  # two sensors
    bench.seconds(3.0)
    assert bench.state == "EXPLORING"
    heard = diagnostics(bench.ros, "/heat_node")
    bench.wait(lambda: any("no thermal sensor 1 and 2" in each.message for each in heard))


def diagnostics(ros: Any, name: str) -> list[DiagnosticStatus]:
    heard: list[DiagnosticStatus] = []
    listener = ros.add(lambda **kwargs: Node("listener", **kwargs))

    def hear(message: DiagnosticArray) -> None:
        heard.extend(each for each in message.status if each.name == name)

    listener.create_subscription(DiagnosticArray, "/diagnostics", hear, qos.DIAGNOSTICS)
    return heard


@pytest.mark.parametrize(
    ("factory", "name"), [(HeatNode, "heat_node"), (NavigatorNode, "navigator_node")]
)
def test_odometry_that_cannot_be_received_is_an_error_line_and_a_diagnostic(
    ros, other_ros, factory, name
):
    other_ros.add(partial(Robot, BEST_EFFORT))
    lines: list[Log] = []
    listener = ros.add(lambda **kwargs: Node("reader", **kwargs))
    listener.create_subscription(Log, "/rosout", lines.append, QoSProfile(depth=100))
    heard = diagnostics(ros, f"/{name}")
    ros.add(factory)
    says = "/odom: nothing of robot is received"
    assert ros.spin_until(lambda: any(says in status.message for status in heard))
    assert heard[-1].level == DiagnosticStatus.ERROR
    assert ros.spin_until(lambda: [each for each in lines if says in each.msg])
    assert {each.level for each in lines if says in each.msg} == {ERROR}


@pytest.mark.parametrize(
    ("stamped", "kind"),
    [
        ("auto", TwistMsg),
        ("auto", TwistStamped),
        ("false", TwistMsg),
        ("true", TwistStamped),
    ],
)
def test_a_robot_that_is_to_stand_is_told_in_the_type_that_it_takes(ros, other_ros, stamped, kind):
    robot = other_ros.add(Robot)
    heard = robot.take(kind)
    ros.add(HeatNode, stamped_cmd_vel=stamped)

    def told() -> bool:
        other_ros.executor.spin_once(timeout_sec=0.0)
        return bool(heard)

    assert ros.spin_until(told)
    assert twist_of(heard[0].twist if kind is TwistStamped else heard[0]) == Twist()
