"""heat_node before a robot that stands in a room; map and transforms come as from SLAM."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import Twist as TwistMsg
from geometry_msgs.msg import TwistStamped
from imus import imu
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, LaserScan
from stand_in_nav2 import StandInNav2
from std_msgs.msg import Float32MultiArray
from tf2_msgs.msg import TFMessage
from warm_room import Room, box

from rover_common import frames, topics
from rover_common.geometry import Pose
from rover_common.ros import qos
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.conversions import grid_message_of, time_of
from rover_common.ros.transforms import transform_message_of
from rover_common.sensor_types import Twist, WheelOdometry
from rover_common.types import GridMap
from rover_heat.node import HeatNode

ROOM = Room(box(4.0, 4.0))
HERE, ORIGIN = Pose(1.5, 1.5, 0.0), Pose(0.0, 0.0, 0.0)
TICK = 50_000_000  # [ns]
PATIENCE = 60.0  # [s] of wall time
SAMPLE, SAMPLES = 10_000_000, 5  # [ns] between two of the inertial unit, and how many to a tick


class Robot(Node):
    """Sensors, transforms and the clock."""

    def __init__(self, odometry: QoSProfile = qos.SENSOR, **kwargs: Any) -> None:
        super().__init__("robot", **kwargs)
        self.stamp = 10_000_000_000  # [ns] of the clock
        self.shift = 0  # [ns] that the sensors' clock is ahead of it
        self.pixels = 64  # of a thermal frame
        self.says = HERE  # its odometry, wherever it is
        self.origin = ORIGIN  # of the odometry in the map
        publish = self.create_publisher
        self.clock = publish(Clock, "/clock", qos.CLOCK)
        self.scan = publish(LaserScan, topics.SCAN, qos.SCAN)
        self.imu = publish(Imu, topics.IMU, qos.IMU)
        self.odometry = publish(Odometry, topics.ODOMETRY, odometry)
        self.thermal = [
            publish(Float32MultiArray, topic, qos.SENSOR)
            for topic in (topics.TEMPERATURE_1, topics.TEMPERATURE_2)
        ]
        self.tf = publish(TFMessage, "/tf", qos.TF)
        self.map = publish(OccupancyGrid, topics.MAP, qos.LATCHED)

    def take(self, kind: type[TwistMsg] | type[TwistStamped]) -> list[Any]:
        """The velocities that come."""
        heard: list[Any] = []
        self.create_subscription(kind, topics.CMD_VEL, heard.append, qos.CONTROL)
        return heard

    def say(self) -> None:
        """All that it says in 0.05 s, but for the clock."""
        self.stamp += TICK
        stamp = self.stamp + self.shift
        for before in reversed(range(SAMPLES)):
            self.imu.publish(sensors.imu_message_of(imu(stamp - before * SAMPLE)))
        odometry = WheelOdometry(stamp, self.says, Twist())
        self.odometry.publish(sensors.wheel_odometry_message_of(odometry))
        body = transform_message_of(stamp, frames.ODOM, frames.BASE_FOOTPRINT, self.says)
        correction = transform_message_of(stamp, frames.MAP, frames.ODOM, self.origin)
        self.tf.publish(TFMessage(transforms=[body, correction]))
        self.scan.publish(sensors.laser_scan_message_of(ROOM.scan(HERE, stamp)))
        for number, publisher in enumerate(self.thermal, 1):
            message = sensors.thermal_message_of(ROOM.thermal(HERE, stamp, number, 0.0))
            message.data = message.data[: self.pixels]
            publisher.publish(message)

    def set_clock(self) -> None:
        self.clock.publish(Clock(clock=time_of(self.stamp)))

    def send_map(self, grid: GridMap, begun: int | None = None) -> None:
        self.map.publish(grid_message_of(self.stamp, grid, begun=begun))


class HeatBench:
    """`tick` lets 0.05 s go by, and waits for what the mission makes of it."""

    def __init__(self, ros: Any, **parameters: Any) -> None:
        self.ros = ros
        self.robot: Robot = ros.add(Robot)
        self.velocities = self.robot.take(TwistStamped)
        self.server: StandInNav2 = ros.add(StandInNav2)
        self._parameters = parameters
        self.speaks = True  # whether the server sends feedback while it has a goal
        self.start()

    def start(self) -> None:
        """A node."""
        self.node: HeatNode = self.ros.add(HeatNode, use_sim_time=True, **self._parameters)
        self.wait(lambda: all(each.get_subscription_count() > 0 for each in self._heard))
        self.wait(lambda: self.node._navigator.is_present and self.node._velocity.connected)

    @property
    def _heard(self) -> list[Any]:
        robot = self.robot
        return [robot.clock, robot.scan, robot.imu, robot.tf, robot.map, *robot.thermal]

    def again(self, seconds: float = 3.0) -> None:
        """The node has ended, and after a while there is another one."""
        if self.server.active:
            self.server.succeed()
        self.ros.end(self.node)
        self.wait(lambda: all(each.get_subscription_count() == 0 for each in self._heard))
        self.robot.stamp += round(seconds / 0.05) * TICK
        self.start()

    def wait(self, predicate: Callable[[], Any]) -> None:
        assert self.ros.spin_until(predicate, timeout=PATIENCE)

    @property
    def state(self) -> str:
        return self.node._core.state.name

    @property
    def reason(self) -> str:
        return self.node._decision.reason

    def tick(self) -> None:
        """The clock goes on when all that was said has come: load changes nothing."""
        counts = self.node._diagnostics.counts
        before = counts["ticks"]
        if self.speaks and self.server.active:
            self.server.report(1.0 + self.robot.stamp % 7 * 0.1, stamp=self.robot.stamp)
            self.wait(lambda: self.node._navigator._heard)
        self.robot.say()
        said = self.node._sensors.collector._said
        self.wait(lambda: said.scans and len(said.imus) >= SAMPLES and said.odometry)
        self.robot.set_clock()
        self.wait(lambda: counts["ticks"] > before)
        self.wait(self._planned)

    def until(self, predicate: Callable[[], Any], seconds: float) -> None:
        """Of simulated time."""
        for _ in range(round(seconds * 20)):
            if predicate():
                return
            self.tick()
        assert predicate(), f"{self.state}: {self.reason}"

    def seconds(self, seconds: float) -> None:
        for _ in range(round(seconds * 20)):
            self.tick()

    def _planned(self) -> bool:
        """The planner has all the time that it would have in front of a real robot."""
        orders = self.node._core._plans._orders
        return all(order.future is None or order.future.done() for order in orders)
