"""Two rovers in one domain, each in a namespace: nothing of the one reaches the other."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

from rover_bridge.node import BridgeNode
from rover_bringup.starts import SHARED
from rover_common.ros import qos
from rover_decision.node import DecisionNode
from rover_perception.node import PerceptionNode
from rover_simulator.node import SimulatorNode
from rover_simulator.simulation import START_TIME

SEEDS = {"one": 1, "two": 2}
SECONDS = 2.0  # [s] of simulated time


def in_namespace(factory: Callable[..., Node], name: str, **kwargs: Any) -> Node:
    """A node as the launch files start it in a namespace."""
    remapped = [f"{topic}:={topic.removeprefix('/')}" for topic in SHARED]
    arguments = [word for each in [f"__ns:=/{name}", *remapped] for word in ("-r", each)]
    return factory(cli_args=["--ros-args", *arguments], **kwargs)


class Rover:
    """One rover's graph, with its simulator."""

    def __init__(self, ros: Any, name: str) -> None:
        def add(factory: Callable[..., Node], **parameters: Any) -> Any:
            return ros.add(partial(in_namespace, factory, name), **parameters)

        self.bridge = add(BridgeNode, port=0, answer_deadline=30.0)
        perception = add(PerceptionNode, use_sim_time=True)
        decision = add(DecisionNode, use_sim_time=True)
        self.nodes = (self.bridge, perception, decision)
        self.simulator = add(
            SimulatorNode,
            port=self.bridge.port,
            seed=SEEDS[name],
            size=0.4,
            rate=0,
            autostart=False,
        )
        self.start = None

    def begin(self) -> None:
        self.simulator.trigger_configure()
        self.simulator.trigger_activate()
        self.start = self.simulator.simulation.pose

    @property
    def moved(self) -> float:
        """[m] from its start."""
        pose = self.simulator.simulation.pose
        return math.hypot(pose.x - self.start.x, pose.y - self.start.y)


@pytest.fixture
def rovers(ros) -> dict[str, Rover]:
    return {name: Rover(ros, name) for name in SEEDS}


def test_two_rovers_drive_apart(ros, rovers):
    heard: dict[str, list[Any]] = {}
    listener = ros.add(lambda **kwargs: Node("listener", **kwargs))
    for prefix in ("", "/one", "/two"):
        for topic, kind, profile in (("tf", TFMessage, qos.TF), ("clock", Clock, qos.CLOCK)):
            heard[f"{prefix}/{topic}"] = messages = []
            listener.create_subscription(kind, f"{prefix}/{topic}", messages.append, profile)
    for rover in rovers.values():
        decided = f"{rover.bridge.get_namespace()}/cmd_drive"
        assert ros.spin_until(lambda name=decided: listener.count_publishers(name) == 1)
        peers = rover.bridge._diagnostics._peers.values()
        assert ros.spin_until(lambda peers=peers: all(connected() for connected in peers))
        rover.begin()
    both = [rover.simulator.simulation for rover in rovers.values()]
    assert ros.spin_until(
        lambda: all(each.time > START_TIME + SECONDS for each in both), timeout=300.0
    )
    for name, rover in rovers.items():
        counts = rover.bridge._diagnostics.counts
        assert counts["deadline_missed"] == counts["second_client"] == 0
        assert rover.moved > 0.2
        assert _follows(heard[f"/{name}/tf"], rover)
        assert heard[f"/{name}/clock"]
    assert heard["/tf"] == heard["/clock"] == []


def _follows(messages: list[TFMessage], rover: Rover) -> bool:
    """Whether all transforms are near this rover's way, which is far from the other's."""
    start = rover.start
    places = [
        link.transform.translation
        for message in messages
        for link in message.transforms
        if link.child_frame_id == "base_link"
    ]
    assert places
    return all(math.hypot(at.x - start.x, at.y - start.y) < 5.0 * SECONDS for at in places)


def test_a_frame_prefix_is_in_every_message_of_a_rover(ros):
    prefix = [Parameter("frame_prefix", value="one/")]
    bridge = ros.add(lambda parameter_overrides, **kwargs: BridgeNode(
        parameter_overrides=parameter_overrides + prefix, **kwargs), port=0)  # fmt: skip
    links: list[TransformStamped] = []  # each is handed on by itself
    bridge.create_subscription(TFMessage, "/tf_static", links.append, qos.TF_STATIC)
    assert ros.spin_until(lambda: len(links) == 3)
    names = {name for link in links for name in (link.header.frame_id, link.child_frame_id)}
    assert names == {
        "one/map", "one/odom", "one/base_link", "one/camera_link", "one/camera_optical_frame",
    }  # fmt: skip
