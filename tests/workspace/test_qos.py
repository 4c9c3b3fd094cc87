"""Every subscription of the graph, its watcher and the RViz view can receive what is published."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
import yaml
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    QoSCompatibility,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
)
from rosgraph_msgs.msg import Clock

from rover_bridge.node import BridgeNode
from rover_common import topics
from rover_common.ros import qos
from rover_dashboard.node import DashboardNode
from rover_decision.node import DecisionNode
from rover_perception.node import PerceptionNode
from rover_tools.runner.node_watch import GraphWatch

RVIZ = Path(__file__).resolve().parents[2] / "rover_bringup" / "rviz" / "rover.rviz"
NODES = {"bridge_node", "perception_node", "decision_node", "dashboard_node"}
WATCH = "watch"
# The page hears of either robot's mission; these are of the one that is not in this graph.
OF_THE_OTHER_ROBOT = {
    f"/{topic}"
    for topic in (
        topics.HEAT_STATE, topics.HEAT_SOURCES, topics.HEAT_MARKERS, topics.MAP,
        topics.TEMPERATURE_1, topics.TEMPERATURE_2,
    )
}  # fmt: skip
# These are of a person or of a navigator that somebody starts.
OF_OTHERS = OF_THE_OTHER_ROBOT | {f"/{topics.CMD_VEL}", f"/{topics.CMD_VEL_TELEOP}"}
# What rclpy itself adds to every node.
OF_EVERY_NODE = {"/rosout", "/parameter_events"}
RELIABILITY = {
    "Reliable": ReliabilityPolicy.RELIABLE, "Best Effort": ReliabilityPolicy.BEST_EFFORT
}  # fmt: skip
DURABILITY = {
    "Transient Local": DurabilityPolicy.TRANSIENT_LOCAL, "Volatile": DurabilityPolicy.VOLATILE
}  # fmt: skip


@dataclass(frozen=True)
class Endpoint:
    """A publisher or a subscription."""

    topic: str
    node: str
    profile: QoSProfile


@dataclass(frozen=True)
class Endpoints:
    publishers: tuple[Endpoint, ...]
    subscriptions: tuple[Endpoint, ...]


@pytest.fixture
def graph(ros, domain_id) -> Iterator[Node]:
    """All nodes in one context, and the watcher in its own; one node that sees them all."""
    bridge = ros.add(BridgeNode, port=0)
    ros.add(PerceptionNode, use_sim_time=True)
    ros.add(DecisionNode, use_sim_time=True)
    ros.add(DashboardNode, port=0).set_watched(True)
    with GraphWatch(domain_id):
        found = NODES | {WATCH}
        assert ros.spin_until(lambda: found <= set(bridge.get_node_names()))
        assert ros.spin_until(lambda: bridge.count_subscribers(topics.MISSION_STATE) > 0)
        yield bridge


def endpoints_of(node: Node) -> Endpoints:
    """All endpoints that a node sees."""
    names = [name for name, _ in node.get_topic_names_and_types() if name not in OF_EVERY_NODE]
    return Endpoints(
        tuple(
            Endpoint(name, info.node_name, info.qos_profile)
            for name in names
            for info in node.get_publishers_info_by_topic(name)
        ),
        tuple(
            Endpoint(name, info.node_name, info.qos_profile)
            for name in names
            for info in node.get_subscriptions_info_by_topic(name)
        ),
    )


def rviz_subscriptions() -> list[Endpoint]:
    """The subscriptions of the RViz view's displays; a policy that is not named is reliable."""
    view = yaml.safe_load(RVIZ.read_text())["Visualization Manager"]["Displays"]
    return [
        Endpoint(
            f"/{topic['Value']}",  # relative, so that the view follows RViz into a namespace
            "rviz",
            QoSProfile(
                depth=topic["Depth"],
                reliability=RELIABILITY[topic.get("Reliability Policy", "Reliable")],
                durability=DURABILITY[topic.get("Durability Policy", "Volatile")],
                liveliness=LivelinessPolicy.AUTOMATIC,
            ),
        )
        for display in view
        if (topic := display.get("Topic"))
    ]


def incompatible(publishers: tuple[Endpoint, ...], subscriptions: list[Endpoint]) -> list[str]:
    """What keeps which subscription from receiving what."""
    problems = []
    for subscription in subscriptions:
        pairs = [p for p in publishers if p.topic == subscription.topic]
        if not pairs and subscription.topic not in OF_OTHERS:
            problems.append(f"{subscription.topic}: {subscription.node} has no publisher")
        for publisher in pairs:
            compatibility, reason = qos_check_compatible(publisher.profile, subscription.profile)
            if compatibility != QoSCompatibility.OK:  # equal, but not the same object
                problems.append(
                    f"{publisher.topic}: {publisher.node} to {subscription.node}: {reason}"
                )
    return problems


def test_every_subscription_fits_its_publishers(graph):
    endpoints = endpoints_of(graph)
    assert {endpoint.node for endpoint in endpoints.subscriptions} == NODES | {WATCH}
    assert incompatible(endpoints.publishers, list(endpoints.subscriptions)) == []


def test_the_rviz_view_fits_the_publishers(graph):
    assert incompatible(endpoints_of(graph).publishers, rviz_subscriptions()) == []


def test_a_reliable_subscription_to_a_best_effort_publisher_is_found(ros, graph):
    reliable = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
    wrong = ros.add(lambda **kwargs: Node("wrong", **kwargs))
    wrong.create_subscription(Clock, "/clock", lambda message: None, reliable)
    assert ros.spin_until(lambda: any(e.node == "wrong" for e in endpoints_of(graph).subscriptions))
    endpoints = endpoints_of(graph)
    (problem,) = incompatible(endpoints.publishers, list(endpoints.subscriptions))
    assert problem.startswith("/clock: bridge_node to wrong: ")


def test_what_users_subscribe_as_sensor_data_they_receive(graph):
    """REP-2003: drivers publish reliably, whoever reads a sensor may do so with best effort."""
    endpoints = endpoints_of(graph)
    sensors = ("camera/", "odom", "free_scan", "rover_status")
    published = [e for e in endpoints.publishers if e.topic.removeprefix("/").startswith(sensors)]
    assert len(published) >= 6
    sensor_data = QoSProfile(
        depth=5,
        reliability=ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.VOLATILE,
        liveliness=LivelinessPolicy.AUTOMATIC,
    )
    wanted = [Endpoint(each.topic, "user", sensor_data) for each in published]
    assert incompatible(endpoints.publishers, wanted) == []


@pytest.mark.parametrize(
    ("profile", "reliable", "best_effort"),
    [(qos.FRAME, True, True), (qos.SENSOR, True, True), (qos.SCAN, False, True),
     (qos.IMU, False, True), (qos.CLOCK, False, True), (qos.VIEW, True, True)],
)  # fmt: skip
def test_which_subscriptions_receive_what_is_published(profile, reliable, best_effort):
    pairs = {ReliabilityPolicy.RELIABLE: reliable, ReliabilityPolicy.BEST_EFFORT: best_effort}
    for policy, receives in pairs.items():
        compatibility, _ = qos_check_compatible(profile, QoSProfile(depth=5, reliability=policy))
        assert (compatibility != QoSCompatibility.ERROR) == receives


def test_the_maps_are_what_a_reader_of_maps_asks_for():
    reader = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    assert qos_check_compatible(qos.LATCHED, reader)[0] != QoSCompatibility.ERROR
