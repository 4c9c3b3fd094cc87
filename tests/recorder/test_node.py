"""The node in a graph: which topics it finds, with which QoS, and what it writes of them."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
from array import array

import cv2
import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from recordings_by_hand import write_recording
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import String
from telemetry import IMAGE, telemetry

from rover_bridge.node import BridgeNode
from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions, qos
from rover_decision.node import DecisionNode
from rover_perception.node import PerceptionNode
from rover_recorder.node import RecorderNode
from rover_recorder.reader import open_recording
from rover_simulator.wire.unity_client import UnityClient
from rover_tools.runner.recording import recorder_command

SECOND = 1_000_000_000  # [ns]
WAIT = 10.0  # [s]


@pytest.fixture
def graph(ros) -> Node:
    """Stands for the rover."""
    return ros.add(lambda **kwargs: Node("graph", **kwargs))


def publish(ros, graph, topic: str, message, profile=qos.FRAME):
    """Publish a message once somebody has subscribed."""
    publisher = graph.create_publisher(type(message), topic, profile)
    assert ros.spin_until(lambda: publisher.get_subscription_count() > 0)
    publisher.publish(message)
    return publisher


def finished(ros, recorder: RecorderNode):
    """The recording of a node that has ended."""
    ros.executor.remove_node(recorder)
    ros.nodes.remove(recorder)
    recorder.destroy_node()
    return open_recording(recorder.writer.path)


def test_messages_are_written_as_they_were_on_the_wire(ros, graph, tmp_path):
    early = graph.create_publisher(String, "early", qos.LATCHED)
    early.publish(String(data="before"))
    recorder = ros.add(RecorderNode, folder=str(tmp_path / "run"))
    odometry = conversions.odometry_of(7 * SECOND, Pose(1.0, 2.0, 0.5), 2.0)
    publish(ros, graph, "odom", odometry)
    clock = publish(ros, graph, "clock", String(), qos.CLOCK)

    def all_written() -> bool:
        clock.publish(String())  # again and again: it is best effort
        return {"/early", "/odom", "/clock"} <= set(recorder.writer.counts)

    assert ros.spin_until(all_written)
    recording = finished(ros, recorder)
    (record,) = recording.records(["/odom"])
    # Not byte by byte: what pads the fields is not defined.
    assert deserialize_message(record.data, Odometry) == odometry
    assert record.publish_time == 7 * SECOND
    assert record.log_time > 1_700_000_000 * SECOND  # of the wall clock
    (record,) = recording.records(["/early"])
    assert deserialize_message(record.data, String).data == "before"
    assert record.publish_time == record.log_time
    topic = recording.topics["/early"]
    assert topic.type == "std_msgs/msg/String"
    assert topic.qos[0]["durability"] == "transient_local"
    assert topic.type_hash.startswith("RIHS01_")
    assert recording.topics["/clock"].qos[0]["reliability"] == "best_effort"


def test_pictures_become_jpeg_but_for_those_that_are(ros, graph, tmp_path):
    recorder = ros.add(RecorderNode, folder=str(tmp_path / "run"))
    picture = np.zeros((20, 40, 3), np.uint8)
    picture[:, 20:] = (200, 30, 30)
    graph.create_publisher(Image, "camera", qos.FRAME)
    assert ros.spin_until(lambda: "camera" in str(recorder.get_topic_names_and_types()))
    recorder.search()  # the other topic may be found later
    jpeg = CompressedImage(format="jpeg", data=array("B", b"a file"))
    publish(ros, graph, "camera/compressed", jpeg)
    publish(ros, graph, "vision", conversions.image_message_of(3 * SECOND, "camera", picture))
    publish(ros, graph, "depth", Image(encoding="mono16"))
    names = {"/camera/compressed", "/vision/compressed"}
    assert ros.spin_until(lambda: names <= set(recorder.writer.counts))
    recording = finished(ros, recorder)
    assert "/camera" not in recording.topics
    assert recording.counts["/depth/compressed"] == 0  # of another encoding
    (record,) = recording.records(["/camera/compressed"])
    assert deserialize_message(record.data, CompressedImage) == jpeg
    (record,) = recording.records(["/vision/compressed"])
    assert recording.topics["/vision/compressed"].type == "sensor_msgs/msg/CompressedImage"
    message = deserialize_message(record.data, CompressedImage)
    assert message.format == conversions.JPEG_FORMAT
    assert record.publish_time == 3 * SECOND
    bgr = cv2.imdecode(np.frombuffer(message.data, np.uint8), cv2.IMREAD_COLOR)
    assert np.abs(bgr[:, :, ::-1].astype(int) - picture).max() < 12


def test_hidden_topics_and_those_to_leave_out_are_left_out(ros, graph, tmp_path):
    graph.create_publisher(String, "task/_action/status", qos.FRAME)
    graph.create_publisher(String, "noise", qos.FRAME)
    graph.create_publisher(String, "static", qos.FRAME)
    recorder = ros.add(RecorderNode, folder=str(tmp_path / "run"), leave_out="noise static")
    publish(ros, graph, "text", String(data="x"))
    assert ros.spin_until(lambda: "/text" in recorder.writer.counts)
    names = set(finished(ros, recorder).topics)
    assert not names & {"/task/_action/status", "/noise", "/static"}


def test_the_graph_is_recorded_with_the_cameras_own_files(ros, tmp_path):
    recorder = ros.add(RecorderNode, folder=str(tmp_path / "run"))
    assert not all(peer() for peer in recorder._diagnostics._peers.values())
    bridge = ros.add(BridgeNode, port=0, answer_deadline=5.0)
    ros.add(PerceptionNode)
    ros.add(DecisionNode)
    peers = recorder._diagnostics._peers.values()
    assert ros.spin_until(lambda: all(peer() for peer in peers))
    client = UnityClient("127.0.0.1", bridge.port)
    client.connect(timeout=5)
    try:
        client.send_telemetry(telemetry())
        wanted = {f"/{topic}" for topic in (topics.COMPRESSED_IMAGE, topics.COMMAND)}
        assert ros.spin_until(lambda: wanted <= set(recorder.writer.counts))
    finally:
        client.close()
    recording = finished(ros, recorder)
    record = next(recording.records([f"/{topics.COMPRESSED_IMAGE}"]))
    assert deserialize_message(record.data, CompressedImage).data.tobytes() == IMAGE
    assert recording.counts[f"/{topics.ODOMETRY}"] >= 1


def test_a_full_disk_ends_the_recording_and_nothing_else(ros, graph, tmp_path, monkeypatch):
    recorder = ros.add(RecorderNode, folder=str(tmp_path / "run"))
    publisher = publish(ros, graph, "text", String(data="kept"))
    assert ros.spin_until(lambda: "/text" in recorder.writer.counts)
    recorder.writer.flush()

    def full() -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(recorder.writer, "flush", full)
    assert ros.spin_until(lambda: recorder.failure is not None)
    publisher.publish(String(data="lost"))
    ros.spin_until(lambda: False, timeout=0.1)
    recording = finished(ros, recorder)
    (record,) = recording.records(["/text"])
    assert deserialize_message(record.data, String).data == "kept"


# As a process


@pytest.fixture
def process(tmp_path, domain_id):
    """The node's executable in this test's domain; it is killed if it is left."""
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain_id)}
    started = subprocess.Popen(
        recorder_command(tmp_path / "a run #1"), env=environment, stderr=subprocess.PIPE, text=True
    )
    yield started
    started.kill()
    started.communicate()


FLUSHES = 3  # the first may have begun before the first text


def record_until(ros, graph, process, number: signal.Signals, tmp_path):
    """Publish numbered texts until the file must hold some, then end the process."""
    folder = tmp_path / "a run #1"
    file = folder / "a run #1_0.mcap"
    publisher = graph.create_publisher(String, "text", qos.FRAME)
    # The recorder gives way to other processes: on a busy machine it starts late.
    assert ros.spin_until(lambda: publisher.get_subscription_count() > 0, timeout=60.0)
    size, count, growths = file.stat().st_size, 0, 0

    def grown() -> bool:
        nonlocal count, size, growths
        publisher.publish(String(data=str(count)))
        count += 1
        before, size = size, file.stat().st_size
        growths += size > before
        return growths == FLUSHES

    assert ros.spin_until(grown)
    process.send_signal(number)
    return folder, count


def texts_of(recording) -> list[str]:
    return [deserialize_message(r.data, String).data for r in recording.records(["/text"])]


def test_a_killed_recorder_leaves_what_it_flushed(ros, graph, process, tmp_path):
    folder, count = record_until(ros, graph, process, signal.SIGKILL, tmp_path)
    assert process.wait(WAIT) == -signal.SIGKILL
    assert not (folder / "metadata.yaml").exists()
    recording = open_recording(folder)
    assert recording.salvaged
    texts = texts_of(recording)
    assert 0 < len(texts) <= count
    assert texts == [str(index) for index in range(len(texts))]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_recording_with_all_that_was_published(
    ros, graph, process, number, tmp_path
):
    folder, count = record_until(ros, graph, process, number, tmp_path)
    assert process.wait(6 * WAIT) == 0  # it gives way to other processes
    recording = open_recording(folder)
    assert not recording.salvaged
    assert texts_of(recording) == [str(index) for index in range(count)]


def test_a_folder_that_holds_a_recording_is_one_line_and_exit_code_1(tmp_path, domain_id):
    file = write_recording(tmp_path / "run")
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain_id)}
    done = subprocess.run(
        recorder_command(file.parent), env=environment, capture_output=True, text=True
    )
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == f"recorder_node: {file} exists already"
    assert "Traceback" not in done.stderr
