"""What goes wrong before and behind the bridge is braked, named in the diagnostics, and ends."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.node import Node
from telemetry import telemetry
from wire_clients import Decider, Unity, answers_to, run_clients

from rover_bridge.node import BridgeNode
from rover_bridge.telemetry_clock import CONFIRMATIONS
from rover_common import topics
from rover_common.ros import conversions, qos

HOUR = 3600.0  # [s]
TELEMETRY, COMMAND = "/bridge_node: telemetry", "/bridge_node: cmd_drive"
ROVER = "/rover"


@pytest.fixture
def status(ros) -> Callable[[str], DiagnosticStatus]:
    """The newest status of a name."""
    newest: dict[str, DiagnosticStatus] = {}
    node = ros.add(lambda **kwargs: Node("listener", **kwargs))

    def hear(message: DiagnosticArray) -> None:
        newest.update((each.name, each) for each in message.status)

    node.create_subscription(DiagnosticArray, "/diagnostics", hear, qos.DIAGNOSTICS)
    return lambda name: newest.get(name, DiagnosticStatus(level=DiagnosticStatus.STALE))


def is_told(
    ros: Any, status: Callable[[str], DiagnosticStatus], name: str, level: bytes, text: str
) -> bool:
    return bool(
        ros.spin_until(lambda: status(name).level == level and text in status(name).message)
    )


def brakes(answer: Any) -> bool:
    return (answer.data["throttle"], answer.data["brake"]) == ("0.0000", "1.0000")


def test_a_telemetry_of_another_hour_is_braked_and_told_and_the_time_goes_on(ros, bridge, status):
    times = [0.04 * step for step in range(1, 41)]
    times[20] += HOUR
    answers = answers_to(ros, bridge.port, *(telemetry(sim_time=time) for time in times))
    assert [brakes(answer) for answer in answers] == [index == 20 for index in range(40)]
    assert answers[20].data["refused"] == "telemetry dropped: sim_time jumped ahead by 3600.0 s"
    assert ros.spin_until(lambda: len(bridge.decider.statuses) == 39)
    stamps = [conversions.stamp_of(each.header.stamp) / 1e9 for each in bridge.decider.statuses]
    assert stamps == pytest.approx([time for time in times if time < HOUR])
    assert {each.run for each in bridge.decider.statuses} == {1}
    assert bridge.node._diagnostics.counts["telemetry_clock_jumped"] == 1


def test_a_clock_that_falls_back_begins_a_run_when_it_goes_on(ros, bridge):
    wires = [telemetry(sim_time=time) for time in (100.0, *(1.0 + 0.1 * n for n in range(9)))]
    answers = answers_to(ros, bridge.port, *wires)
    refused = ["refused" in answer.data for answer in answers]
    assert refused == [False] + [True] * CONFIRMATIONS + [False] * (9 - CONFIRMATIONS)
    statuses = bridge.decider.statuses
    assert ros.spin_until(lambda: len(statuses) == 10 - CONFIRMATIONS)
    assert [each.run for each in statuses] == [1] + [2] * (9 - CONFIRMATIONS)


def test_simulated_time_without_sim_time_is_told_and_ends_with_one(ros, status):
    node = ros.add(BridgeNode, port=0, answer_deadline=5.0, use_sim_time=True)
    decider = ros.add(Decider)
    assert ros.spin_until(lambda: node.count_subscribers(topics.COMMAND) > 0)
    assert ros.spin_until(lambda: decider.count_publishers(topics.STATUS) > 0)
    (answer,) = answers_to(ros, node.port, telemetry())
    assert brakes(answer)
    assert "use_sim_time" in answer.data["refused"]
    assert is_told(ros, status, TELEMETRY, DiagnosticStatus.ERROR, "use_sim_time")
    (answer,) = answers_to(ros, node.port, telemetry(sim_time=1.0))
    assert not brakes(answer)


def test_a_decision_that_is_silent_is_told_with_its_age(ros, status):
    node = ros.add(BridgeNode, port=0)
    decider = ros.add(Decider)
    assert ros.spin_until(lambda: node.count_subscribers(topics.COMMAND) > 0)
    assert ros.spin_until(lambda: decider.count_publishers(topics.STATUS) > 0)
    publisher, decider._publisher = decider._publisher, Silent()

    def body() -> None:
        with Unity(node.port) as unity:
            time = 1.0
            while status(COMMAND).level != DiagnosticStatus.ERROR:
                time += 0.04
                assert brakes(unity.ask(telemetry(sim_time=time)))

    assert ros.spin_until(lambda: status(TELEMETRY).level == DiagnosticStatus.OK)
    run_clients(ros, body)
    assert "none usable for " in status(COMMAND).message
    assert "no decision in time" in status(COMMAND).message
    assert status(TELEMETRY).level == DiagnosticStatus.OK
    assert is_told(ros, status, ROVER, DiagnosticStatus.WARN, "the simulator has left")
    decider._publisher = publisher
    (answer,) = answers_to(ros, node.port, telemetry(sim_time=900.0))
    assert not brakes(answer)


class Silent:
    """In place of a publisher."""

    def publish(self, message: Any) -> None:
        pass


def test_a_simulator_that_is_silent_is_told(ros, bridge, status):
    def body() -> None:
        with Unity(bridge.port) as unity:
            unity.ask(telemetry(sim_time=1.0))
            while status(TELEMETRY).level != DiagnosticStatus.ERROR:
                pass
            assert "simulator is silent" in status(TELEMETRY).message
            assert status(COMMAND).level == DiagnosticStatus.OK
            unity.ask(telemetry(sim_time=1.1))
            while status(TELEMETRY).level == DiagnosticStatus.ERROR:
                pass

    run_clients(ros, body)
