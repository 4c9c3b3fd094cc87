"""A node that cannot start says why in one line; a parameter that it ignores is told."""

import os
import subprocess
import sys

import pytest
from rclpy.node import Node

from rover_common.errors import CANNOT_START
from rover_common.ros.parameters import declare_parameters, unknown_parameters
from rover_decision.missions.sample_return.config import DecisionConfig

START = "import sys; sys.argv[0] = 'bridge_node'; from rover_bridge.node import main; main()"


def start(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", START, "--ros-args", "--disable-rosout-logs", *arguments],
        capture_output=True, text=True, env=os.environ | {"ROS_DOMAIN_ID": "44"},
    )  # fmt: skip


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("-p", "port:=80000"), "port"),
        (("-p", "port:=eighty"), "port"),
        (("-p", "answer_deadline:=.inf"), "answer_deadline"),
        (("-p", "insets:=perhaps"), "insets"),
        (("-p", "truth:=/none/map.png"), "/none/map.png"),
        (("--params-file", sys.executable), "params file"),
        (("--params-file", "/none.yaml"), "/none.yaml"),
        (("--no-such-argument",), "no-such-argument"),
    ],
)
def test_what_a_node_cannot_use_is_one_line(arguments, reason):
    done = start(*arguments)
    assert done.returncode == CANNOT_START
    lines = [line for line in done.stderr.splitlines() if not line.startswith("[")]
    assert len(lines) == 1
    assert lines[0].startswith("bridge_node: ")
    assert reason in lines[0]


def test_a_parameter_that_is_ignored_is_told_with_the_nearest(ros):
    node = ros.add(lambda **kwargs: Node("n", **kwargs), explorrer="tour", x=1)
    declare_parameters(node, DecisionConfig)
    assert unknown_parameters(node) == ["'explorrer'; did you mean 'explorer'?", "'x'"]
