"""The node that the insets are drawn from, and the truth that colours them."""

from __future__ import annotations

import pytest
import rclpy
from node_endpoints import endpoints, listed
from rclpy.context import Context
from rclpy.parameter import Parameter
from readme_tables import ROOT

from rover_bridge.node import BridgeNode
from rover_bridge.node_insets import InsetNode
from rover_common.errors import RoverError
from rover_common.frames import MAP
from rover_common.ros.runner import start_errors


def test_the_topics_are_those_of_the_readme(ros):
    node = InsetNode(ros.add(BridgeNode, port=0), MAP)
    try:
        found = endpoints(node.subscriptions)
    finally:
        node.destroy_node()
    assert found == listed(ROOT / "rover_bridge" / "README.md", "Subscribes for the insets")


def test_the_node_has_the_bridges_namespace_and_topics(domain_id):
    arguments = ["--ros-args", "-r", "__ns:=/one", "-r", "__node:=two", "-r", "worldmap:=three"]
    context = Context()
    rclpy.init(context=context, args=arguments, domain_id=domain_id)
    bridge = BridgeNode(context=context, parameter_overrides=[Parameter("port", value=0)])
    node = InsetNode(bridge, MAP)
    try:
        assert node.get_fully_qualified_name() == "/one/two_insets"
        assert {s.topic_name for s in node.subscriptions} >= {"/one/three", "/one/rocks"}
    finally:
        node.destroy_node()
        bridge.destroy_node()
        context.try_shutdown()


def test_a_wrong_truth_is_one_clear_line(ros, capsys):
    with pytest.raises(RoverError, match=r"nothing\.png: No such file or directory"):
        ros.add(BridgeNode, port=0, truth="nothing.png")
    with pytest.raises(SystemExit), start_errors():
        ros.add(BridgeNode, port=0, truth=str(ROOT / "README.md"))
    assert capsys.readouterr().err.endswith("README.md: not an image\n")
