"""The topics of one telemetry."""

from __future__ import annotations

from collections.abc import Callable

from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.subscription import Subscription
from rosgraph_msgs.msg import Clock as ClockMsg
from rover_interfaces.msg import RoverStatus
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from tf2_msgs.msg import TFMessage

from rover_bridge import conversions
from rover_bridge.config import BridgeConfig
from rover_bridge.yaw_rate import YawRate
from rover_common import topics
from rover_common.frames import Frames
from rover_common.ros import qos
from rover_common.ros.conversions import image_message_of, jpeg_message_of, odometry_of
from rover_common.types import Run, Telemetry


class TelemetryPublishers:
    """Publishes all messages of a telemetry with its stamp."""

    def __init__(self, node: Node, frames: Frames, config: BridgeConfig) -> None:
        self._frames = frames
        self._yaw_rate = YawRate()
        publish = node.create_publisher
        self._image = publish(Image, topics.IMAGE, qos.FRAME)
        self._compressed = publish(CompressedImage, topics.COMPRESSED_IMAGE, qos.FRAME)
        self._odometry = publish(Odometry, topics.ODOMETRY, qos.FRAME)
        self._status = publish(RoverStatus, topics.STATUS, qos.FRAME)
        self._camera_info = publish(CameraInfo, topics.CAMERA_INFO, qos.FRAME)
        self._clock = publish(ClockMsg, "/clock", qos.CLOCK)
        self._tf = publish(TFMessage, "/tf", qos.TF)
        self._tf_static = publish(TFMessage, "/tf_static", qos.TF_STATIC)
        now = int(node.get_clock().now().nanoseconds)
        static = conversions.static_transforms_of(now, frames, config.camera_transforms)
        self._tf_static.publish(static)

    def publish(self, stamp: int, run: Run, telemetry: Telemetry) -> None:
        """What the other nodes wait for comes first."""
        frames, pose, speed = self._frames, telemetry.pose, telemetry.speed
        image = image_message_of(stamp, frames.camera_optical, telemetry.image)
        yaw_rate = self._yaw_rate.follow(run, stamp, pose.yaw)
        self._odometry.publish(odometry_of(stamp, pose, speed, yaw_rate, frames))
        self._image.publish(image)
        self._status.publish(conversions.status_of(stamp, run, telemetry, frames))
        if telemetry.sim_time is not None:
            self._clock.publish(conversions.clock_of(stamp))
        self._tf.publish(conversions.body_transform_of(stamp, pose, frames))
        self._camera_info.publish(conversions.camera_info_of(stamp, frames))
        if self._compressed.get_subscription_count() > 0:
            self._compressed.publish(jpeg_message_of(image.header, telemetry.jpeg))

    def peers(self, command: Subscription) -> dict[str, Callable[[], bool]]:
        """Whether the nodes are there that work on a telemetry, and answer it by `command`."""
        return {
            "perception": lambda: self._image.get_subscription_count() > 0,
            "odometry": lambda: self._odometry.get_subscription_count() > 1,
            "decision": lambda: (
                command.get_publisher_count() > 0 and self._status.get_subscription_count() > 0
            ),
        }
