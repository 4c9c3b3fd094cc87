"""A navigator node, and its robot in a maze on a plane: tick by tick, over the wire."""

from __future__ import annotations

from typing import Any

import numpy as np
from geometry_msgs.msg import TwistStamped
from maze_world import MazeWorld
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.task import Future
from rover_interfaces.msg import NavigationTick, SensorTick
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage

from rover_common import frames, topics
from rover_common.geometry import Pose
from rover_common.ros import qos
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.conversions import stamp_of
from rover_common.ros.transforms import pose_message_of
from rover_common.sensor_batches import Tick
from rover_common.sensor_types import SensorBatch, Twist
from rover_navigation.node import NavigatorNode

NO_ODOMETRY = Pose(0.0, 0.0, 0.0)


class NavigatorBench:
    """`tick` moves the robot as it was told, and waits for what the navigator says to it."""

    def __init__(self, ros: Any, walls: np.ndarray, start: Pose, **parameters: Any) -> None:
        self.ros = ros
        self.world = MazeWorld(walls, start, seed=1, odometry_at=NO_ODOMETRY)
        self.node = ros.add(NavigatorNode, lockstep=True, samples=200, **parameters)
        self.peer = ros.add(lambda **kwargs: Node("robot", **kwargs))
        publish, listen = self.peer.create_publisher, self.peer.create_subscription
        self._scan = publish(LaserScan, topics.SCAN, qos.SCAN)
        self._imu = publish(Imu, topics.IMU, qos.IMU)
        self._odometry = publish(Odometry, topics.ODOMETRY, qos.SENSOR)
        self._tick = publish(SensorTick, topics.SENSOR_TICK, qos.SENSOR)
        self.hazards = publish(OccupancyGrid, topics.HAZARD_MAP, qos.LATCHED)
        self.velocities: list[TwistStamped] = []
        self.ticks: list[NavigationTick] = []
        self.maps: list[OccupancyGrid] = []
        self.transforms: list[TFMessage] = []
        self.plans: list[Path] = []
        self.feedback: list[NavigateToPose.Feedback] = []
        listen(TwistStamped, topics.CMD_VEL, self.velocities.append, qos.CONTROL)
        listen(NavigationTick, topics.NAVIGATION_TICK, self.ticks.append, qos.SENSOR)
        listen(OccupancyGrid, topics.MAP, self.maps.append, qos.LATCHED)
        listen(TFMessage, "/tf", self.transforms.append, qos.TF)
        listen(Path, topics.PLAN, self.plans.append, qos.VIEW)
        self.client = ActionClient(self.peer, NavigateToPose, topics.NAVIGATE)
        for publisher in (self._scan, self._imu, self._odometry, self._tick, self.hazards):
            self.spin_until(lambda p=publisher: p.get_subscription_count() > 0)
        self.spin_until(lambda: self.node._velocity.connected and self.client.server_is_ready())

    def spin_until(self, predicate: Any) -> None:
        assert self.ros.spin_until(predicate)

    def tick(self) -> Twist:
        """One tick of 0.05 s; what the navigator tells the robot, zero when nothing."""
        twist = self.twist_of_last()
        self.send(batch := self.world.step(twist))
        self.spin_until(lambda: self.ticks and stamp_of(self.ticks[-1].header.stamp) == batch.stamp)
        if self.ticks[-1].velocity:
            self.spin_until(
                lambda: (
                    self.velocities and stamp_of(self.velocities[-1].header.stamp) == batch.stamp
                )
            )
        return self.twist_of_last()

    def twist_of_last(self) -> Twist:
        """The answer to the last tick."""
        if not (self.ticks and self.ticks[-1].velocity):
            return Twist()
        return sensors.twist_of(self.velocities[-1].twist)

    def send(self, batch: SensorBatch) -> None:
        for imu in batch.imus:
            self._imu.publish(sensors.imu_message_of(imu))
        for odometry in batch.odometry:
            self._odometry.publish(sensors.wheel_odometry_message_of(odometry))
        for scan in batch.scans:
            self._scan.publish(sensors.laser_scan_message_of(scan))
        self._tick.publish(sensors.tick_message_of(Tick.of(batch)))

    def wait(self, seconds: float) -> None:
        """So many seconds of the robot."""
        for _ in range(round(seconds * 20)):
            self.tick()

    def send_goal(self, pose: Pose, frame: str = frames.MAP) -> Any:
        """Give a goal, of the world's frame; its handle, accepted or not."""
        goal = NavigateToPose.Goal(pose=pose_message_of(0, frame, self.world.in_map(pose)))
        return self.result_of(
            self.client.send_goal_async(goal, lambda m: self.feedback.append(m.feedback))
        )

    def result_of(self, future: Future) -> Any:
        self.spin_until(future.done)
        return future.result()

    def drive(self, future: Future, seconds: float) -> Any:
        """Tick until the future is done."""
        for _ in range(round(seconds * 20)):
            if future.done():
                break
            self.tick()
        return self.result_of(future)
