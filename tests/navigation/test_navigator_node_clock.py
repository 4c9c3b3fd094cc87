"""The navigator node by the clock: it steps without a lockstep, and lets the robot go."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from geometry_msgs.msg import TwistStamped
from maze_world import MazeWorld, box
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage

from rover_common import frames, topics
from rover_common.geometry import Pose
from rover_common.ros import qos
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.conversions import time_of
from rover_common.ros.runner import EventsExecutor
from rover_common.ros.transforms import pose_message_of, transform_message_of
from rover_common.sensor_types import Twist
from rover_navigation.node import NavigatorNode

HALL = np.array(box(0.0, 0.0, 3.0, 2.0))
START = Pose(0.5, 0.5, 0.0)
FIRST = 100  # ticks of the world: a clock that reads zero counts as not yet set


class Robot(Node):
    """Simulated time: each call of `go` is 0.05 s of it."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("robot", **kwargs)
        self.world = MazeWorld(HALL, START, seed=1, odometry_at=Pose(0.0, 0.0, 0.0))
        self.world._ticks = FIRST
        self.velocities: list[TwistStamped] = []
        self.links: list[tuple[str, str]] = []
        self._clock_publisher = self.create_publisher(Clock, "/clock", qos.CLOCK)
        self._scan = self.create_publisher(LaserScan, topics.SCAN, qos.SCAN)
        self._imu = self.create_publisher(Imu, topics.IMU, qos.IMU)
        self._odometry = self.create_publisher(Odometry, topics.ODOMETRY, qos.SENSOR)
        self.tf = self.create_publisher(TFMessage, "/tf", qos.TF)
        listen = self.create_subscription
        listen(TwistStamped, topics.CMD_VEL, self.velocities.append, qos.CONTROL)
        listen(TFMessage, "/tf", self._on_transforms, qos.TF)

    def go(self) -> None:
        told = self.velocities[-1].twist if self.velocities else None
        batch = self.world.step(Twist() if told is None else sensors.twist_of(told))
        for scan in batch.scans:
            self._scan.publish(sensors.laser_scan_message_of(scan))
        for imu in batch.imus:
            self._imu.publish(sensors.imu_message_of(imu))
        for odometry in batch.odometry:
            self._odometry.publish(sensors.wheel_odometry_message_of(odometry))
        self._clock_publisher.publish(Clock(clock=time_of(batch.stamp)))

    def _on_transforms(self, message: TFMessage) -> None:
        self.links += [(link.header.frame_id, link.child_frame_id) for link in message.transforms]


@pytest.fixture(params=[SingleThreadedExecutor, EventsExecutor], ids=["single", "events"])
def robot(ros, request):
    ros.executor.shutdown()
    ros.executor = request.param(context=ros.context)
    robot = ros.add(Robot)
    robot.navigator = ros.add(NavigatorNode, use_sim_time=True, samples=100)
    assert ros.spin_until(lambda: robot._scan.get_subscription_count() > 0)
    assert ros.spin_until(lambda: robot._clock_publisher.get_subscription_count() > 0)
    return robot


def run(ros: Any, robot: Robot, done: Any, ticks: int = 200) -> bool:
    """Let the time go on until something holds; each time until the navigator has seen it."""
    counts = robot.navigator._diagnostics.counts
    for _ in range(ticks):
        if done():
            return True
        steps = counts["steps"]
        robot.go()
        ros.spin_until(lambda steps=steps: counts["steps"] > steps or done(), timeout=1.0)
    return ros.spin_until(done, timeout=0.2)


def test_it_drives_by_the_clock_and_tells_the_robot_to_stop_at_the_end(ros, robot):
    client = ActionClient(robot, NavigateToPose, topics.NAVIGATE)
    assert run(ros, robot, lambda: (frames.MAP, frames.ODOM) in robot.links)
    assert run(ros, robot, lambda: robot.world.stamp > 2_500_000_000 and client.server_is_ready())
    pose = robot.world.in_map(Pose(2.0, 0.5, 0.0))
    sent = client.send_goal_async(NavigateToPose.Goal(pose=pose_message_of(0, frames.MAP, pose)))
    assert run(ros, robot, sent.done)
    assert run(ros, robot, lambda: robot.velocities and robot.velocities[-1].twist.linear.x > 0.05)
    canceled = sent.result().cancel_goal_async()
    assert run(ros, robot, canceled.done)
    stopped = TwistStamped().twist
    assert run(ros, robot, lambda: robot.velocities[-1].twist == stopped)
    count = len(robot.velocities)
    assert not run(ros, robot, lambda: len(robot.velocities) > count, ticks=10)
    client.destroy()


def test_it_sends_the_odometrys_transform_where_the_robot_does_not(ros, robot):
    ours = (frames.ODOM, frames.BASE_FOOTPRINT)
    assert run(ros, robot, lambda: ours in robot.links)
    assert robot.world.stamp > 3_000_000_000


def test_it_leaves_that_transform_to_a_robot_that_sends_it(ros, robot):
    link = transform_message_of(0, frames.ODOM, frames.BASE_FOOTPRINT, Pose(0.0, 0.0, 0.0))
    robot.tf.publish(TFMessage(transforms=[link]))
    assert run(ros, robot, lambda: robot.world.stamp > 4_000_000_000)
    assert robot.links.count((frames.ODOM, frames.BASE_FOOTPRINT)) == 1
