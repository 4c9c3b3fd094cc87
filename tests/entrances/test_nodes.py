"""No message ends a node, and one that is refused changes nothing of it."""

from __future__ import annotations

import ast
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from cases import SEQUENCES, fuzzed
from hostile_messages import BEGIN, GOOD, changed
from hypothesis import given
from hypothesis import strategies as st
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from snapshots import snapshot
from tf2_msgs.msg import TFMessage

from burger_simulator.node import BurgerNode
from rover_bridge.node import BridgeNode
from rover_common.ros.checked_node import CheckedNode, Entrance, left_alone
from rover_common.ros.conversions import time_of
from rover_dashboard.node import DashboardNode
from rover_decision.node import DecisionNode
from rover_heat.node import HeatNode
from rover_navigation.node import NavigatorNode
from rover_perception.node import PerceptionNode
from rover_recorder.node import RecorderNode

ROOT = Path(__file__).resolve().parents[2]
STEP = 50_000_000  # [ns]
AWAY = st.sampled_from([0, 0, 0, 0, -STEP, -BEGIN, 3 * STEP, 3600 * BEGIN])  # [ns] of a stamp
CHANGES = st.sampled_from([0, 0, 0, 1, 2])  # values changed of a message
SKIPS = st.sampled_from([False, False, False, True])
NODES: dict[str, Callable[[Any], Any]] = {
    "bridge": lambda ros: ros.add(BridgeNode, port=0),
    "perception": lambda ros: ros.add(PerceptionNode, use_sim_time=True),
    "decision": lambda ros: ros.add(DecisionNode, use_sim_time=True),
    "dashboard": lambda ros: watched(ros.add(DashboardNode, use_sim_time=True)),
    "heat": lambda ros: ros.add(HeatNode, use_sim_time=True),
    "heat_lockstep": lambda ros: ros.add(HeatNode, use_sim_time=True, lockstep=True),
    "navigator": lambda ros: ros.add(NavigatorNode, use_sim_time=True),
    "navigator_lockstep": lambda ros: ros.add(NavigatorNode, use_sim_time=True, lockstep=True),
    "burger": lambda ros: ros.add(BurgerNode, start_paused=True),
}


def watched(node: DashboardNode) -> DashboardNode:
    node.set_watched(True)
    return node


@pytest.fixture(params=NODES)
def node(ros, request) -> Any:
    return NODES[request.param](ros)


def test_every_subscription_of_a_node_has_an_entrance(node):
    assert isinstance(node, CheckedNode)
    subscriptions = list(node.subscriptions)
    assert subscriptions
    for each in subscriptions:
        assert isinstance(each.callback, Entrance), each.topic_name


def test_every_subscription_of_the_recorder_has_an_entrance(ros, tmp_path):
    recorder = ros.add(RecorderNode, folder=str(tmp_path / "recording"))
    talker = ros.add(lambda **kwargs: Node("talker", **kwargs))
    talker.create_publisher(Clock, "ticks", 10)

    def found() -> list[Any]:
        recorder.search()
        return list(recorder.subscriptions)

    assert ros.spin_until(found)
    assert all(isinstance(each.callback, Entrance) for each in found())


def test_no_node_of_the_programs_is_a_plain_one():
    packages = [path.parent for path in ROOT.glob("*/package.xml")]
    for path in (path for each in packages for path in (each / each.name).rglob("*.py")):
        text = path.read_text()
        if path.name == "checked_node.py" or "from launch_ros.actions import Node" in text:
            continue
        for each in ast.walk(ast.parse(text)):
            bases = each.bases if isinstance(each, ast.ClassDef) else []
            names = [each.func] if isinstance(each, ast.Call) else bases
            assert not [n for n in names if isinstance(n, ast.Name) and n.id == "Node"], path


def heard_types(node: Any) -> list[tuple[Any, Any]]:
    return [(each, each.msg_type) for each in node.subscriptions if not each.raw]


def hear(node: Any, subscription: Any, message: Any) -> None:
    """As the executor hands it over; what is refused leaves the node as it was."""
    refused = refusals(node)
    before = snapshot(node, node.counts)
    subscription.callback(message)
    failed = [key for key in node.counts if key.startswith("failed_")]
    assert not failed
    wholly = subscription.msg_type is not TFMessage
    if wholly and subscription.callback._refused is left_alone and refusals(node) > refused:
        assert snapshot(node, node.counts) == before


def refusals(node: Any) -> int:
    return sum(count for key, count in node.counts.items() if key.startswith("refused_"))


def test_hostile_messages_end_no_node_and_refused_ones_change_nothing(node):
    clock = [each for each, kind in heard_types(node) if kind is Clock]
    now = [BEGIN]

    @fuzzed(SEQUENCES)
    @given(st.data())
    def node_case(data: Any) -> None:
        now[0] += STEP
        for each in clock:
            each.callback(Clock(clock=time_of(now[0])))
        for subscription, kind in heard_types(node):
            if kind is Clock or data.draw(SKIPS):
                continue
            stamp = max(0, now[0] + data.draw(AWAY))
            message = data.draw(changed(kind, data.draw(CHANGES), stamp))
            hear(node, subscription, message)
        for timer in list(node.timers):
            timer.callback()

    node_case()


def test_good_messages_are_all_taken(node):
    clock = [each for each, kind in heard_types(node) if kind is Clock]
    for each in clock:
        each.callback(Clock(clock=time_of(BEGIN)))
    for subscription, kind in heard_types(node):
        if kind is not Clock:
            hear(node, subscription, GOOD[kind])
    assert refusals(node) == 0
