"""When the recorder says that it records."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rover_interfaces.msg import RoverStatus
from sensor_msgs.msg import CompressedImage
from std_msgs.msg import String

from rover_common import topics
from rover_common.ros import qos
from rover_recorder.node import NEEDED, RecorderNode


def test_it_is_ready_when_each_publisher_that_reports_was_heard_after_all_were_subscribed(
    ros, tmp_path
):
    """Not before: a publisher that has not found it yet does not send to it."""
    recorder = ros.add(RecorderNode, folder=str(tmp_path / "run"), mission="drive")
    graph = ros.add(lambda **kwargs: Node("graph", **kwargs))
    foreign = ros.add(lambda **kwargs: Node("foreign", **kwargs))
    kinds = {topics.COMPRESSED_IMAGE: CompressedImage, topics.ODOMETRY: Odometry}
    for topic in NEEDED["drive"]["bridge"]:
        graph.create_publisher(kinds.get(topic, RoverStatus), topic, qos.FRAME)
    for topic in NEEDED["drive"]["perception"]:
        foreign.create_publisher(String, topic, qos.LATCHED)  # it reports to nobody
    diagnostics = graph.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    peers = recorder._diagnostics._peers
    assert ros.spin_until(peers["perception"])
    assert ros.spin_until(lambda: diagnostics.get_subscription_count() >= 2)
    assert not peers["bridge"]()
    diagnostics.publish(DiagnosticArray(status=[DiagnosticStatus(name="/other: peers")]))
    diagnostics.publish(DiagnosticArray(status=[DiagnosticStatus(name="/graph: peers")]))
    assert ros.spin_until(peers["bridge"])
