"""What a node's entrances count and say, and what they hand on."""

from __future__ import annotations

import copy
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Polygon
from hostile_messages import BEGIN, GOOD
from nav_msgs.msg import OccupancyGrid, Odometry
from rcl_interfaces.msg import Log
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from rover_common.ros import qos
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.conversions import time_of
from rover_common.ros.diagnostics import NodeDiagnostics

SECOND = 1_000_000_000  # [ns]


class Listener(CheckedNode):
    """Keeps what passes."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("listener", **kwargs)
        self.heard: list[Any] = []
        self.refused: list[Any] = []
        self.diagnostics = NodeDiagnostics(self, {})

    def entrance(self, kind: type, topic: str = "topic") -> Any:
        return self.create_subscription(
            kind, topic, self.heard.append, qos.SENSOR, refused=self.refused.append
        ).callback


@pytest.fixture
def listener(ros) -> Listener:
    return ros.add(Listener, use_sim_time=True)


def empty_scan() -> LaserScan:
    scan = copy.deepcopy(GOOD[LaserScan])
    scan.ranges = scan.ranges[:0]
    return scan


def test_a_refused_message_over_dds_is_counted_in_the_diagnostics_and_told_once(ros, listener):
    listener.entrance(LaserScan, "scan")
    talker = ros.add(lambda **kwargs: Node("talker", **kwargs))
    lines: list[Log] = []
    reports: list[DiagnosticArray] = []
    talker.create_subscription(Log, "/rosout", lines.append, QoSProfile(depth=100))
    talker.create_subscription(DiagnosticArray, "/diagnostics", reports.append, qos.DIAGNOSTICS)
    scans = talker.create_publisher(LaserScan, "scan", qos.SENSOR)
    assert ros.spin_until(lambda: scans.get_subscription_count() == 1)
    for message in [*[empty_scan()] * 3, GOOD[LaserScan]]:
        scans.publish(message)
    assert ros.spin_until(lambda: listener.heard)
    assert [len(each.ranges) > 0 for each in listener.heard] == [True]
    assert listener.counts == {"refused_scan_size": 3}

    def told() -> bool:
        values = [v for r in reports for s in r.status for v in s.values]
        return any((v.key, v.value) == ("refused_scan_size", "3") for v in values)

    assert ros.spin_until(told)
    assert ros.spin_until(lambda: lines)
    assert len([each for each in lines if "scan: refused: 0 rays" in each.msg]) == 1


def test_what_is_refused_is_handed_to_who_has_to_answer_it(listener):
    take = listener.entrance(LaserScan)
    take(empty_scan())
    assert (len(listener.heard), len(listener.refused)) == (0, 1)


def test_a_map_in_another_frame_is_refused(listener):
    take = listener.entrance(OccupancyGrid)
    listener.expect_frames({"topic": "map"})
    for frame in ("odom", "", "map"):
        grid = copy.deepcopy(GOOD[OccupancyGrid])
        grid.header.frame_id = frame
        take(grid)
    assert [each.header.frame_id for each in listener.heard] == ["map"]
    assert listener.counts["refused_topic_frame"] == 2


@pytest.mark.parametrize(
    ("ahead", "taken"), [(-BEGIN, True), (0, True), (SECOND, True), (60 * SECOND, False)]
)
def test_a_stamp_far_ahead_of_the_clock_is_refused(ros, listener, ahead, taken):
    (clock,) = [each for each in listener.subscriptions if each.msg_type is Clock]
    take = listener.entrance(Odometry)
    clock.callback(Clock(clock=time_of(BEGIN)))
    message = copy.deepcopy(GOOD[Odometry])
    message.header.stamp = time_of(BEGIN + ahead)
    take(message)
    assert bool(listener.heard) is taken
    assert listener.counts["refused_topic_stamp"] == (not taken)


def test_a_clock_that_is_no_time_is_refused(listener):
    (clock,) = [each for each in listener.subscriptions if each.msg_type is Clock]
    clock.callback(Clock(clock=time_of(BEGIN)))
    broken = Clock()
    broken.clock.sec = -5
    clock.callback(broken)
    assert listener.get_clock().now().nanoseconds == BEGIN
    assert listener.counts["refused_clock_stamp"] == 1


def test_one_bad_transform_does_not_hide_the_others(listener):
    take = listener.entrance(TFMessage, "/tf")
    links = copy.deepcopy(GOOD[TFMessage])
    links.transforms[0].transform.rotation.w = 0.0
    links.transforms[0].transform.rotation.z = 0.0
    take(links)
    assert listener.heard == [links.transforms[1]]
    assert listener.counts == {"refused_tf_rotation": 1}


def test_a_failure_of_the_node_itself_is_counted_and_the_next_message_is_taken(listener):
    failing = [True]

    def take(message: Odometry) -> None:
        if failing.pop():
            raise IndexError("a defect")

    entrance = listener.create_subscription(Odometry, "odom", take, qos.SENSOR).callback
    entrance(GOOD[Odometry])
    assert listener.counts.pop("failed_odom") == 1
    failing.append(False)
    entrance(GOOD[Odometry])
    assert not listener.counts


def test_a_timer_that_fails_is_counted_told_once_and_called_again(ros):
    calls: list[int] = []

    def _look_around() -> None:
        calls.append(len(calls))
        if len(calls) % 2:
            raise IndexError("a defect")

    listener, talker = ros.add(Listener), ros.add(lambda **kwargs: Node("talker", **kwargs))
    lines: list[Log] = []
    talker.create_subscription(Log, "/rosout", lines.append, QoSProfile(depth=100))
    ros.spin_until(lambda: talker.count_publishers("/rosout") > 1)
    timer = listener.create_timer(0.01, _look_around)
    assert ros.spin_until(lambda: len(calls) > 4 and any("defect" in line.msg for line in lines))
    listener.destroy_timer(timer)
    assert listener.counts.pop("failed_look_around") == (len(calls) + 1) // 2
    (told,) = [line.msg for line in lines if "look_around" in line.msg]
    assert told.startswith("look_around: failed:")
    assert "IndexError: a defect" in told


def test_a_type_without_a_check_cannot_be_subscribed(listener):
    with pytest.raises(KeyError):
        listener.create_subscription(Polygon, "shape", listener.heard.append, qos.SENSOR)
