"""A perception node, its input by hand, and what it publishes."""

from __future__ import annotations

from typing import Any

import numpy as np
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rover_interfaces.msg import PolarArray, RoverStatus
from scene import draw
from sensor_msgs.msg import Image, LaserScan

from rover_common import frames, topics
from rover_common.geometry import Pose
from rover_common.ros import conversions, qos
from rover_common.types import FIRST_RUN, Run
from rover_perception.node import PerceptionNode

POSE = Pose(90.0, 100.0, 0.0)
IMAGE = draw(POSE, lambda x, y: (y > 95) & (y < 105))


class Peer:
    """The node's surroundings: publishes its input and keeps its output in lists."""

    def __init__(self, ros) -> None:
        self.ros = ros
        self.node = ros.add(PerceptionNode, image_lag=0)
        self.peer = ros.add(lambda **kwargs: Node("peer", **kwargs))
        self._image = self.peer.create_publisher(Image, topics.IMAGE, qos.FRAME)
        self._odometry = self.peer.create_publisher(Odometry, topics.ODOMETRY, qos.FRAME)
        self._status = self.peer.create_publisher(RoverStatus, topics.STATUS, qos.FRAME)
        self.got: dict[str, list[Any]] = {}
        self.listen(PolarArray, topics.NAV_POLAR, qos.FRAME)
        self.listen(PolarArray, topics.ROCK_POLAR, qos.FRAME)
        self.listen(LaserScan, topics.FREE_SCAN, qos.FRAME)
        for publisher in (self._image, self._odometry, self._status):
            assert ros.spin_until(lambda publisher=publisher: publisher.get_subscription_count())
        assert ros.spin_until(lambda: self.node.count_subscribers(topics.FREE_SCAN) > 0)

    def listen(self, kind: type, topic: str, profile: Any) -> list[Any]:
        self.got[topic] = []
        self.peer.create_subscription(kind, topic, self.got[topic].append, profile)
        return self.got[topic]

    def send(
        self,
        stamp: int,
        pose: Pose = POSE,
        image: np.ndarray = IMAGE,
        run: Run = FIRST_RUN,
        **fields: Any,
    ) -> None:
        """A telemetry; `fields` replace those of its image message."""
        message = conversions.image_message_of(stamp, frames.CAMERA_OPTICAL, image)
        for name, value in fields.items():
            setattr(message, name, value)
        self._image.publish(message)
        self._odometry.publish(conversions.odometry_of(stamp, pose, 0.0))
        header = conversions.header_of(stamp, frames.BASE)
        start = conversions.time_of(run.start)
        self._status.publish(RoverStatus(header=header, run=run.number, run_start=start))
