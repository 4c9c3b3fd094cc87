"""The topics of what the robot's sensors say."""

from __future__ import annotations

from nav_msgs.msg import Odometry
from rclpy.node import Node
from rosgraph_msgs.msg import Clock as ClockMsg
from rover_interfaces.msg import SensorTick
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Float32MultiArray, String
from tf2_msgs.msg import TFMessage

from burger_simulator import conversions
from burger_simulator.config import BurgerConfig
from burger_simulator.sensors.accuracy import OdometryAccuracy, imu_covariance
from burger_simulator.simulation import START
from rover_common import topics
from rover_common.frames import Frames
from rover_common.ros import qos
from rover_common.ros import sensor_conversions as sensors
from rover_common.sensor_batches import Tick
from rover_common.sensor_types import SensorBatch

DONE = "done"  # what the launcher reports


class SensorPublishers:
    """Publishes batches, of one robot since it was switched on."""

    def __init__(self, node: Node, config: BurgerConfig, frames: Frames) -> None:
        self._frames = frames
        publish = node.create_publisher
        self._scan = publish(LaserScan, topics.SCAN, qos.SCAN)
        self._imu = publish(Imu, topics.IMU, qos.IMU)
        self._odometry = publish(Odometry, topics.ODOMETRY, qos.SENSOR)
        self._thermal = (
            publish(Float32MultiArray, topics.TEMPERATURE_1, qos.SENSOR),
            publish(Float32MultiArray, topics.TEMPERATURE_2, qos.SENSOR),
        )
        self.launched = publish(String, topics.FLYWHEEL_STATUS, qos.CONTROL)
        self._tick = publish(SensorTick, topics.SENSOR_TICK, qos.SENSOR)
        self._clock = publish(ClockMsg, "/clock", qos.CLOCK)
        self._tf = publish(TFMessage, "/tf", qos.TF)
        self._tf_static = publish(TFMessage, "/tf_static", qos.TF_STATIC)
        yaws = config.thermal_yaw_1, config.thermal_yaw_2
        self._tf_static.publish(conversions.static_transforms_of(START, yaws, frames))
        self._lockstep = config.lockstep
        self.switch_on(START)

    def switch_on(self, stamp: int) -> None:
        """The robot begins anew at a stamp [ns]."""
        self._began = stamp
        self._accuracy = OdometryAccuracy()

    def heard(self) -> tuple[int, ...]:
        """How many listen to what driver and mission need, and to what the mission alone does."""
        of_both = (self._scan, self._imu, self._odometry, self._tick)
        publishers = (*of_both, *self._thermal, self.launched)
        return tuple(publisher.get_subscription_count() for publisher in publishers)

    def publish(self, batch: SensorBatch) -> None:
        """The clock comes first, the tick that ends the batch last."""
        frames = self._frames
        self._clock.publish(conversions.clock_of(batch.stamp))
        for imu in batch.imus:
            covariance = imu_covariance((imu.stamp - self._began) * 1e-9)
            self._imu.publish(sensors.imu_message_of(imu, covariance, frames))
        for odometry in batch.odometry:
            accuracy = self._accuracy.follow(odometry)
            message = sensors.wheel_odometry_message_of(odometry, accuracy, frames)
            self._odometry.publish(message)
            self._tf.publish(conversions.body_transform_of(odometry, frames))
        for scan in batch.scans:
            self._scan.publish(sensors.laser_scan_message_of(scan, frames))
        for frame in batch.thermal:
            self._thermal[frame.sensor - 1].publish(sensors.thermal_message_of(frame))
        for _ in range(batch.launches_done):
            self.launched.publish(String(data=DONE))
        if self._lockstep:
            self._tick.publish(sensors.tick_message_of(Tick.of(batch), frames))
