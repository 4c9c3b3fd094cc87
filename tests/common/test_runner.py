"""A node that is ended while it publishes ends without a word, whatever it is doing."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest

# Ended within a callback that goes on publishing, as a slow one does; says when it is there.
NODE = """
import os, signal
from rclpy.node import Node
from std_msgs.msg import String
from rover_common.ros.runner import run_node

class Busy(Node):
    def __init__(self):
        super().__init__("busy")
        self._publisher = self.create_publisher(String, "busy", 1)
        self.create_timer(0.01, self._work)

    def _work(self):
        os.kill(os.getpid(), {number})
        for _ in range(50000):
            self._publisher.publish(String(data="more"))
        print("published", flush=True)

    def destroy_node(self):
        self._publisher.publish(String(data="last"))
        print("closed", flush=True)
        super().destroy_node()

run_node(Busy)
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM], ids=["SIGINT", "SIGTERM"])
def test_a_node_that_is_ended_while_it_publishes_logs_nothing(number):
    done = subprocess.run(
        [sys.executable, "-c", NODE.format(number=int(number))],
        env=os.environ | {"ROS_DOMAIN_ID": "44"}, capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[-2:] == ["published", "closed"]
