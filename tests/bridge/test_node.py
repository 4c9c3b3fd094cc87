"""The bridge node's topics: one stamp per telemetry, runs, the clock and the diagnostics."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from rover_interfaces.msg import DriveCommand, RoverStatus
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import String
from telemetry import START, telemetry
from wire_clients import DRIVE, Unity, answers_to, run_clients

from rover_bridge.counters import Counter
from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions, qos
from rover_common.types import Command, Run

# A time source needs the newest clock only, this test every one.
EVERY_CLOCK = QoSProfile(depth=50, reliability=ReliabilityPolicy.BEST_EFFORT)
FAR_AWAY = Pose(START.x + 50.0, START.y, 0.0)


class Watcher(Node):
    """Keeps all messages of some topics."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("watcher", **kwargs)
        self.got: dict[str, list[Any]] = {}

    def watch(self, ros: Any, kind: type, topic: str, profile: Any) -> list[Any]:
        messages = self.got.setdefault(topic, [])
        self.create_subscription(kind, topic, messages.append, profile)
        assert ros.spin_until(lambda: self.count_publishers(topic))
        return messages


@pytest.fixture
def watcher(ros) -> Watcher:
    return ros.add(Watcher)


def stamps(statuses: list[RoverStatus]) -> list[int]:
    return [conversions.stamp_of(status.header.stamp) for status in statuses]


def test_one_stamp_for_all_messages_of_one_telemetry(ros, bridge, watcher):
    kinds = {
        topics.IMAGE: Image,
        topics.CAMERA_INFO: CameraInfo,
        topics.ODOMETRY: Odometry,
        topics.STATUS: RoverStatus,
    }
    got = [watcher.watch(ros, kind, topic, qos.FRAME) for topic, kind in kinds.items()]
    answers_to(ros, bridge.port, telemetry(), telemetry())
    assert ros.spin_until(lambda: all(len(messages) == 2 for messages in got))
    for messages in zip(*got, strict=True):
        assert len({conversions.stamp_of(message.header.stamp) for message in messages}) == 1
    image, info, odometry, status = (messages[0] for messages in got)
    assert (image.height, image.width, image.encoding) == (160, 320, "rgb8")
    assert info.k[0] == pytest.approx(114.25, abs=0.01)
    assert odometry.pose.pose.position.x == pytest.approx(99.67)
    assert odometry.child_frame_id == "base_link"
    assert status.sample_count == 2
    assert list(status.sample_x) == pytest.approx([109.78, 62.63])


def test_simulated_time_is_the_stamp_and_the_clock(ros, bridge, watcher):
    clocks = watcher.watch(ros, Clock, "/clock", qos.CLOCK)
    wires = [telemetry(sim_time=time) for time in (7.5, 7.5, 8.0)]
    answers_to(ros, bridge.port, *wires)
    assert ros.spin_until(lambda: len(bridge.decider.statuses) == 3)
    assert stamps(bridge.decider.statuses) == [7_500_000_000, 7_500_000_001, 8_000_000_000]
    assert ros.spin_until(lambda: clocks)


def test_a_reloaded_scene_begins_a_run_and_the_clock_never_falls_back(ros, bridge, watcher):
    clocks = watcher.watch(ros, Clock, "/clock", EVERY_CLOCK)
    before = [telemetry(sim_time=time) for time in (100.0, 100.1)]
    reloaded = [telemetry(sim_time=time) for time in (0.9, 0.95, 1.0, 1.1)]  # two are left out
    answers_to(ros, bridge.port, *before)
    answers_to(ros, bridge.port, *reloaded)  # on another socket
    statuses = bridge.decider.statuses
    assert ros.spin_until(lambda: len(statuses) == 4)
    assert [status.run for status in statuses] == [1, 1, 2, 2]
    starts = [conversions.run_of(status) for status in statuses]
    assert starts[2] == starts[3] == Run(2, stamps(statuses)[2])
    assert all(a < b for a, b in pairwise(stamps(statuses)))

    def times() -> list[int]:
        return [conversions.stamp_of(clock.clock) for clock in clocks]

    assert ros.spin_until(lambda: times() == stamps(statuses))


def test_a_simulator_that_connects_again_goes_on_with_its_run(ros, bridge):
    answers_to(ros, bridge.port, telemetry(sim_time=5.0))
    answers_to(ros, bridge.port, telemetry(sim_time=9.0))
    assert ros.spin_until(lambda: len(bridge.decider.statuses) == 2)
    assert [status.run for status in bridge.decider.statuses] == [1, 1]


def test_a_simulator_without_a_clock_begins_a_run_where_its_rover_was_placed(ros, bridge):
    answers_to(ros, bridge.port, telemetry(), *[telemetry(pose=FAR_AWAY)] * 3)
    assert ros.spin_until(lambda: len(bridge.decider.statuses) == 2)
    assert [status.run for status in bridge.decider.statuses] == [1, 2]


def test_a_single_wrong_pose_is_left_out_answered_with_the_brake_and_counted(ros, bridge):
    wires = telemetry(), telemetry(pose=FAR_AWAY), telemetry()
    answers = answers_to(ros, bridge.port, *wires)
    assert [float(answer.data["brake"]) for answer in answers] == [0.0, 1.0, 0.0]
    assert ros.spin_until(lambda: len(bridge.decider.statuses) == 2)
    assert [status.run for status in bridge.decider.statuses] == [1, 1]
    assert bridge.node._diagnostics.counts[Counter.UNCONFIRMED] == 1


def test_a_command_with_new_run_begins_one_run(ros, bridge):
    def body() -> None:
        with Unity(bridge.port) as unity:
            bridge.decider.command = Command(brake=1.0, new_run=True)
            for time in (1.0, 1.1, 1.2):  # three pending requests, all answered with new_run
                unity.send(telemetry(sim_time=time))
            for _ in range(3):
                assert unity.next_answer() is not None
            bridge.decider.command = DRIVE
            unity.ask(telemetry(sim_time=1.3))

    run_clients(ros, body)
    statuses = bridge.decider.statuses
    assert ros.spin_until(lambda: len(statuses) == 4)
    # A telemetry that was pending when the first command arrived may be of either run.
    runs = [status.run for status in statuses]
    assert runs[0] == 1
    assert all(b - a in (0, 1) for a, b in pairwise(runs))
    assert runs[-1] == max(runs) > 1


def test_a_late_command_of_an_ended_run_begins_no_run(ros, bridge):
    late = ros.add(lambda **kwargs: Node("late", **kwargs))
    publisher = late.create_publisher(DriveCommand, topics.COMMAND, qos.FRAME)
    assert ros.spin_until(lambda: publisher.get_subscription_count() > 0)
    answers_to(ros, bridge.port, telemetry(sim_time=100.0))
    reloaded = [telemetry(sim_time=1.0)] * 3
    answers_to(ros, bridge.port, *reloaded)  # on another socket
    assert ros.spin_until(lambda: len(bridge.decider.statuses) == 2)
    publisher.publish(
        conversions.command_message_of(0, 0, Run(1, 0), Command(brake=1.0, new_run=True))
    )
    counts = bridge.node._diagnostics.counts
    assert ros.spin_until(lambda: counts[Counter.COMMANDS_LATE] == 1)
    answers_to(ros, bridge.port, telemetry(sim_time=1.1))
    assert ros.spin_until(lambda: len(bridge.decider.statuses) == 3)
    assert [status.run for status in bridge.decider.statuses] == [1, 2, 2]


def test_the_bridge_state_tells_whether_a_client_is_active(ros, bridge, watcher):
    states = watcher.watch(ros, String, topics.BRIDGE_STATE, qos.LATCHED)
    assert ros.spin_until(lambda: [state.data for state in states] == ["disconnected"])
    answers_to(ros, bridge.port, telemetry())
    expected = ["disconnected", "connected", "disconnected"]
    assert ros.spin_until(lambda: [state.data for state in states] == expected)


def test_the_diagnostics_count_what_came_and_how_it_was_answered(ros, bridge, watcher):
    arrays = watcher.watch(ros, DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    answers_to(ros, bridge.port, telemetry(), telemetry() | {"speed": "fast"})

    def values() -> dict[str, str]:
        statuses = [s for array in arrays for s in array.status if s.name == "/bridge_node"]
        return {pair.key: pair.value for pair in statuses[-1].values} if statuses else {}

    expected = {
        Counter.CONNECTIONS: "1",
        Counter.TELEMETRIES: "1",
        Counter.RUNS: "1",
        Counter.ANSWERED: "1",
        "telemetry_not_a_number": "1",
        "state": "disconnected",
    }
    assert ros.spin_until(lambda: values() == expected), values()
