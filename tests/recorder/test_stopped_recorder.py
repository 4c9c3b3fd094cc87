"""A recorder that gets no processor for a while writes what was published meanwhile."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Iterator

import pytest
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from std_msgs.msg import String

from rover_common.ros import qos
from rover_recorder.reader import open_recording
from rover_tools.runner.domain import free_domain
from rover_tools.runner.recording import recorder_command

WAIT = 60.0  # [s]
TOPICS = [f"/text_{number}" for number in range(20)]
COUNT = 50  # texts on each: a publisher keeps four, and by default DDS 512 in all
STOPPED = 2.0  # [s] in which they are published; by default DDS takes it for dead after 1 s


@pytest.fixture
def domain_id() -> Iterator[int]:
    """One in which no recorder was killed: for some seconds the next one would have its port."""
    with free_domain() as domain:
        yield domain


def test_a_recorder_that_stands_still_for_seconds_loses_nothing(ros, tmp_path, domain_id):
    graph = ros.add(lambda **kwargs: Node("graph", **kwargs))
    publishers = [graph.create_publisher(String, topic, qos.FRAME) for topic in TOPICS]
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain_id)}
    process = subprocess.Popen(recorder_command(tmp_path / "run"), env=environment)
    try:
        assert ros.spin_until(lambda: all(p.get_subscription_count() > 0 for p in publishers), WAIT)
        process.send_signal(signal.SIGSTOP)
        for index in range(COUNT):
            for publisher in publishers:
                publisher.publish(String(data=str(index)))
            ros.spin_until(lambda: False, STOPPED / COUNT)
        process.send_signal(signal.SIGCONT)
        file = tmp_path / "run" / "run_0.mcap"
        size = file.stat().st_size
        assert ros.spin_until(lambda: file.stat().st_size > size, WAIT)
        process.send_signal(signal.SIGINT)
        assert process.wait(WAIT) == 0
    finally:
        process.kill()
        process.wait()
    recording = open_recording(tmp_path / "run")
    for topic in TOPICS:
        texts = [deserialize_message(r.data, String).data for r in recording.records([topic])]
        assert texts == [str(index) for index in range(COUNT)], topic
