"""The node in a graph: what it hears of and when, what it stores, what it asks for."""

from __future__ import annotations

import asyncio
from array import array

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.node import Node
from rover_interfaces.msg import DriveCommand, MissionState, RoverStatus
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions, qos
from rover_dashboard.feed import VIEWS
from rover_dashboard.log import Cursor
from rover_dashboard.node import DashboardNode, GraphRobot, spinning
from rover_dashboard.protocol import MissionRequest, ParameterChange, PlaybackChange
from rover_decision.node import DecisionNode

WATCHED = {
    topics.COMPRESSED_IMAGE, topics.VISION_IMAGE, topics.WORLDMAP, topics.PLAN,
    topics.MISSION_MARKERS, topics.COMMAND, topics.MAP, topics.HEAT_MARKERS, topics.HEAT_SOURCES,
    topics.TEMPERATURE_1, topics.TEMPERATURE_2,
}  # fmt: skip
ALWAYS = {
    topics.ODOMETRY, topics.STATUS, topics.MISSION_STATE, topics.BRIDGE_STATE, topics.HEAT_STATE,
    "tf", "diagnostics",
}  # fmt: skip
OF_ROVER = {"camera", "vision", "map", "plan", "markers"}


def heard_of(node: Node) -> set[str]:
    names = {subscription.topic_name.lstrip("/") for subscription in node.subscriptions}
    return names & (WATCHED | ALWAYS)


@pytest.fixture
def dashboard(ros) -> DashboardNode:
    return ros.add(DashboardNode, port=0)


@pytest.fixture
def graph(ros) -> Node:
    """Stands for the rover."""
    return ros.add(lambda **kwargs: Node("graph", **kwargs))


def test_images_and_maps_are_heard_of_only_while_watched(ros, dashboard, graph):
    assert heard_of(dashboard) == ALWAYS
    dashboard.set_watched(True)
    assert heard_of(dashboard) == ALWAYS | WATCHED
    assert ros.spin_until(lambda: all(graph.count_subscribers(topic) == 1 for topic in WATCHED))
    dashboard.set_watched(True)
    assert ros.spin_until(lambda: all(graph.count_subscribers(topic) == 1 for topic in WATCHED))
    dashboard.set_watched(False)
    assert heard_of(dashboard) == ALWAYS
    assert ros.spin_until(lambda: not any(graph.count_subscribers(topic) for topic in WATCHED))


def test_what_was_watched_is_forgotten_with_the_last_viewer(dashboard):
    for name in VIEWS:
        dashboard.slots.put(name, [])
    dashboard.slots.put("vehicle", {})
    dashboard.set_watched(True)
    dashboard.set_watched(False)
    assert all(dashboard.slots.get(name).value is None for name in VIEWS)
    assert dashboard.slots.get("vehicle").value == {}


def publish_frame(graph: Node, stamp: int, x: float, run: int = 1, run_start: int = 0) -> None:
    publishers = graph.__dict__.setdefault("frame_publishers", (
        graph.create_publisher(Odometry, topics.ODOMETRY, qos.FRAME),
        graph.create_publisher(RoverStatus, topics.STATUS, qos.FRAME),
    ))  # fmt: skip
    status = RoverStatus(
        header=conversions.header_of(stamp, "base_link"), run=run, steering_angle=0.2,
        run_start=conversions.time_of(run_start),
    )  # fmt: skip
    publishers[0].publish(conversions.odometry_of(stamp, Pose(x, 50.0, 1.0), 2.0))
    publishers[1].publish(status)


def track_of(node: DashboardNode) -> list:
    news = node.history.since("track", Cursor())
    return news.rows if news else []


def test_the_track_is_kept_while_nobody_looks_and_cleared_with_the_run(ros, dashboard, graph):
    publish_frame(graph, 0, 10.0)
    assert ros.spin_until(lambda: graph.count_subscribers(topics.STATUS) == 1)
    assert ros.spin_until(lambda: graph.count_subscribers(topics.ODOMETRY) == 1)
    publish_frame(graph, 1_000_000_000, 11.0)
    assert ros.spin_until(lambda: (11.0, 50.0) in track_of(dashboard))
    vehicle = dashboard.slots.get("vehicle").value
    assert (vehicle["x"], vehicle["speed"], vehicle["steering"]) == (11.0, 2.0, 11.5)
    assert vehicle["yaw"] == pytest.approx(57.3)
    dashboard.slots.put("plan", [(1.0, 1.0)])
    publish_frame(graph, 5_000_000_000, 30.0, run=2, run_start=5_000_000_000)
    assert ros.spin_until(lambda: track_of(dashboard) == [(30.0, 50.0)])
    assert dashboard.slots.get("plan").value is None


def test_every_topic_fills_its_slot(ros, dashboard, graph):
    dashboard.set_watched(True)
    image = conversions.image_message_of(0, "camera", np.zeros((2, 4, 3), np.uint8))
    grid = OccupancyGrid(data=array("b", [0, 100, -1, -1]))
    grid.info.width = grid.info.height = 2
    grid.info.resolution = 1.0
    markers = MarkerArray(markers=[Marker(ns="goal", action=Marker.DELETE)])
    statuses = [
        DiagnosticStatus(level=DiagnosticStatus.WARN, name="/bridge_node", message="one of many"),
        DiagnosticStatus(level=DiagnosticStatus.ERROR, name="/rover", message="the cause"),
    ]
    sent = {
        topics.COMPRESSED_IMAGE: (CompressedImage(), qos.FRAME),
        topics.VISION_IMAGE: (image, qos.VIEW),
        topics.WORLDMAP: (grid, qos.LATCHED),
        topics.PLAN: (Path(), qos.VIEW),
        topics.MISSION_MARKERS: (markers, qos.VIEW),
        topics.COMMAND: (DriveCommand(), qos.FRAME),
        topics.MISSION_STATE: (MissionState(state_name="STOP"), qos.LATCHED),
        topics.BRIDGE_STATE: (String(data="connected"), qos.LATCHED),
        "/diagnostics": (DiagnosticArray(status=statuses), qos.DIAGNOSTICS),
    }
    for topic, (message, profile) in sent.items():
        publisher = graph.create_publisher(type(message), topic, profile)
        assert ros.spin_until(lambda p=publisher: p.get_subscription_count() == 1)
        publisher.publish(message)
    slots = dashboard.slots
    names = {*OF_ROVER, "mission", "simulator", "health"}
    assert ros.spin_until(lambda: all(slots.get(name) for name in names))
    assert slots.get("mission").value["state"] == "STOP"
    assert slots.get("simulator").value == "connected"
    assert slots.get("health").value == {"level": 2, "text": "the cause"}
    assert slots.get("markers").value == {"goal": []}


def test_an_image_that_cannot_be_shown_is_left_out(dashboard):
    dashboard._on_message(topics.VISION_IMAGE, Image(encoding="mono8"))
    assert dashboard.slots.get("vision") is None


@pytest.fixture
def decision(ros) -> DecisionNode:
    return ros.add(DecisionNode)


def asked_of(ros, dashboard: DashboardNode, ask) -> object:
    """The result of a coroutine function of a GraphRobot, while all nodes spin."""
    ros.executor.remove_node(dashboard)
    with spinning(dashboard) as executor:
        robot = GraphRobot(dashboard, executor)

        async def main() -> object:
            task = asyncio.create_task(ask(robot))
            while not task.done():
                await asyncio.to_thread(ros.executor.spin_once, 0.05)
            return task.result()

        return asyncio.run(main())


def test_requests_and_parameters_reach_the_decision_node(ros, dashboard, decision):
    trigger = dashboard.requests._triggers["decision_node", "pause"]
    assert ros.spin_until(lambda: trigger.service_is_ready())
    assert ros.spin_until(lambda: dashboard.requests._set.service_is_ready())
    assert ros.spin_until(lambda: dashboard.requests._get.service_is_ready())

    async def ask(robot: GraphRobot) -> tuple:
        return (
            await robot.carry_out(MissionRequest("resume")),
            await robot.carry_out(MissionRequest("pause")),
            await robot.carry_out(ParameterChange("top_speed", 2.0)),
            await robot.carry_out(ParameterChange("top_speed", 99.0)),
            await robot.carry_out(PlaybackChange("playing", 1.0)),
        )

    resumed, paused, slower, too_fast, played = asked_of(ros, dashboard, ask)
    assert not resumed.ok
    assert resumed.text == "not possible now; resume: IDLE"
    assert paused.ok
    assert paused.text == "pause: PAUSED"
    assert slower.ok
    assert decision.get_parameter("top_speed").value == 2.0
    assert not too_fast.ok
    assert "range" in too_fast.text
    assert dashboard.slots.get("parameters").value["top_speed"] == 2.0
    assert not played.ok
    assert "live" in played.text


def test_without_a_decision_node_the_answer_says_so(ros, dashboard):
    async def ask(robot: GraphRobot) -> tuple:
        wishes = MissionRequest("pause"), ParameterChange("explorer", "tour")
        return tuple([await robot.carry_out(wish) for wish in wishes])

    for answer in asked_of(ros, dashboard, ask):
        assert not answer.ok
        assert "no answer from decision_node" in answer.text
    assert dashboard.slots.get("parameters").value is None


def test_watching_reaches_the_node_through_its_executor(ros, dashboard, graph):
    async def ask(robot: GraphRobot) -> list[bool]:
        counts = []
        for watched in (True, False):
            robot.watch(watched)
            while (graph.count_subscribers(topics.VISION_IMAGE) == 1) is not watched:
                await asyncio.sleep(0)
            counts.append(watched)
        return counts

    assert asked_of(ros, dashboard, ask) == [True, False]
    assert heard_of(dashboard) == ALWAYS
