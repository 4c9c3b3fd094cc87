"""No message ends heat_node or navigator_node: what cannot be used is dropped and counted."""

from __future__ import annotations

from array import array
from typing import Any

import pytest
from geometry_msgs.msg import Quaternion, TransformStamped
from heat_bench import HERE, ROOM, HeatBench, Robot
from imus import imu
from mapped_rooms import map_of
from tf2_msgs.msg import TFMessage

from rover_common import frames
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.conversions import grid_message_of
from rover_common.ros.message_checks import INVALID
from rover_common.sensor_types import Twist, WheelOdometry
from rover_navigation.node import NavigatorNode

NO_ROTATION = Quaternion(x=0.0, y=0.0, z=0.0, w=0.5)


def hostile_scan(robot: Robot) -> None:
    message = sensors.laser_scan_message_of(ROOM.scan(HERE, robot.stamp))
    message.angle_increment = float("nan")
    robot.scan.publish(message)


def hostile_imu(robot: Robot) -> None:
    message = sensors.imu_message_of(imu(robot.stamp))
    message.linear_acceleration.z = float("inf")
    robot.imu.publish(message)


def hostile_odometry(robot: Robot) -> None:
    message = sensors.wheel_odometry_message_of(WheelOdometry(robot.stamp, HERE, Twist()))
    message.pose.pose.orientation = NO_ROTATION
    robot.odometry.publish(message)


def hostile_map(robot: Robot) -> None:
    message = grid_message_of(robot.stamp, map_of(ROOM, [(1.5, 1.5)]))
    message.data = message.data[:-1]
    robot.map.publish(message)


def hostile_transform(robot: Robot) -> None:
    link = TransformStamped(child_frame_id=frames.BASE_FOOTPRINT)
    link.header.frame_id = frames.ODOM
    link.transform.rotation = NO_ROTATION
    robot.tf.publish(TFMessage(transforms=[link]))


def no_rays(robot: Robot) -> None:
    message = sensors.laser_scan_message_of(ROOM.scan(HERE, robot.stamp))
    message.ranges = array("f")
    robot.scan.publish(message)


HOSTILE = [hostile_scan, hostile_imu, hostile_odometry, hostile_map, hostile_transform]


def test_heat_node_drops_and_counts_them_and_its_mission_goes_on(ros):
    bench = HeatBench(ros)
    bench.robot.send_map(map_of(ROOM, [(1.5, 1.5)]))
    bench.until(lambda: bench.server.goals, 8.0)
    counts = bench.node._sensors.counts
    for number, send in enumerate(HOSTILE, start=1):
        send(bench.robot)
        bench.wait(lambda number=number: counts[INVALID] == number)
    no_rays(bench.robot)
    bench.seconds(1.0)
    assert bench.state == "EXPLORING"
    assert bench.node._diagnostics.counts[INVALID] == len(HOSTILE)


@pytest.mark.parametrize("send", HOSTILE[:3], ids=lambda send: send.__name__)
def test_navigator_node_drops_and_counts_them(ros, send: Any):
    node = ros.add(NavigatorNode)
    robot = ros.add(Robot)
    for publisher in (robot.scan, robot.imu, robot.odometry):
        assert ros.spin_until(lambda p=publisher: p.get_subscription_count() > 0)
    send(robot)
    assert ros.spin_until(lambda: node._invalid[INVALID] == 1)
