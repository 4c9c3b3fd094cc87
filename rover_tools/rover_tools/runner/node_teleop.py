"""A node that drives by velocities, as a person asks for them, and sees what comes of it."""

from __future__ import annotations

from nav_msgs.msg import Odometry
from std_msgs.msg import String

from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.velocity import VelocityPublisher
from rover_common.sensor_types import Twist
from rover_tools.runner.node_in_domain import NodeInDomain

MOST_HEARD = 5  # messages between two velocities: odometry comes 50 times a second at most


class Teleop(NodeInDomain):
    """Publishes cmd_vel_teleop, in the type that the bridge takes."""

    def __init__(self, domain_id: int) -> None:
        super().__init__("teleop", domain_id)
        self.driver = ""  # who drives, as the bridge says
        self.speed = 0.0  # [m/s]
        self._velocity = VelocityPublisher(self.node, "auto", topic=topics.CMD_VEL_TELEOP)
        self.node.create_subscription(Odometry, topics.ODOMETRY, self._on_odometry, qos.FRAME)
        self.node.create_subscription(String, topics.DRIVER, self._on_driver, qos.LATCHED)

    def drive(self, wanted: Twist) -> None:
        """Say it, and hear what there is to hear."""
        self._velocity.publish(int(self.node.get_clock().now().nanoseconds), wanted)
        for _ in range(MOST_HEARD):
            self.executor.spin_once(timeout_sec=0.0)

    def _on_odometry(self, message: Odometry) -> None:
        self.speed = message.twist.twist.linear.x

    def _on_driver(self, message: String) -> None:
        self.driver = message.data
