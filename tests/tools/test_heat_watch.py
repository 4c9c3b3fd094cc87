"""What the watch of a heat mission takes from the graph."""

from __future__ import annotations

from rclpy.node import Node
from tf2_msgs.msg import TFMessage

from rover_common.frames import BASE_FOOTPRINT, MAP, ODOM
from rover_common.geometry import Pose
from rover_common.ros import qos
from rover_common.ros.transforms import transform_message_of
from rover_tools.runner.node_heat_watch import HeatWatch


def test_both_links_of_the_pose_are_kept_with_their_stamps(ros, domain_id):
    correction, odometry = Pose(0.1, 0.2, 0.3), Pose(1.0, 2.0, -0.5)
    node = ros.add(lambda **kwargs: Node("robot", **kwargs))
    publisher = node.create_publisher(TFMessage, "/tf", qos.TF)
    watch = HeatWatch(domain_id)
    try:
        assert ros.spin_until(lambda: publisher.get_subscription_count() > 0)
        publisher.publish(
            TFMessage(
                transforms=[
                    transform_message_of(7, f"tb1/{MAP}", f"tb1/{ODOM}", correction),
                    transform_message_of(8, ODOM, BASE_FOOTPRINT, odometry),
                    transform_message_of(9, BASE_FOOTPRINT, "base_scan", odometry),
                ]
            )
        )
        assert ros.spin_until(lambda: watch.corrections and watch.odometry)
        assert not watch.node.counts
    finally:
        watch.close()
    assert [stamp for stamp, _ in (*watch.corrections, *watch.odometry)] == [7, 8]
    assert abs(watch.corrections[0][1].yaw - correction.yaw) < 1e-9
    assert watch.odometry[0][1].x == odometry.x
