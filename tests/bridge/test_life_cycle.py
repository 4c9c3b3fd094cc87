"""The bridge as a lifecycle node: it activates itself, brakes when it is not active, and ends."""

from __future__ import annotations

import socket
from functools import partial
from typing import Any

import pytest
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from nav_msgs.msg import Odometry
from telemetry import telemetry
from wire_clients import answers_to

from rover_bridge.counters import Counter
from rover_bridge.node import BridgeNode
from rover_bridge.server import PortInUseError
from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import qos


def change(ros: Any, node: BridgeNode, transition: int) -> bool:
    client = node.create_client(ChangeState, "bridge_node/change_state")
    assert ros.spin_until(client.service_is_ready)
    future = client.call_async(ChangeState.Request(transition=Transition(id=transition)))
    assert ros.spin_until(future.done)
    return bool(future.result().success)


def test_it_answers_with_decisions_while_it_is_active_and_brakes_otherwise(ros, bridge):
    counts = bridge.node._diagnostics.counts
    answers_to(ros, bridge.port, telemetry(sim_time=1.0))
    assert counts[Counter.ANSWERED] == 1
    assert change(ros, bridge.node, Transition.TRANSITION_DEACTIVATE)
    (answer,) = answers_to(ros, bridge.port, telemetry(sim_time=1.1))
    assert float(answer.data["brake"]) == 1.0
    assert float(answer.data["throttle"]) == 0.0
    assert counts[Counter.INACTIVE] == 1
    assert change(ros, bridge.node, Transition.TRANSITION_ACTIVATE)
    answers_to(ros, bridge.port, telemetry(sim_time=1.2))
    assert counts[Counter.ANSWERED] == 2


def test_a_transition_that_does_not_lead_on_is_refused_and_the_bridge_goes_on(ros, bridge):
    assert not change(ros, bridge.node, Transition.TRANSITION_ACTIVATE)
    assert not change(ros, bridge.node, 99)
    answers_to(ros, bridge.port, telemetry(sim_time=1.0))
    assert bridge.node._diagnostics.counts[Counter.ANSWERED] == 1


def test_without_autostart_it_listens_when_it_is_configured(ros):
    node = ros.add(BridgeNode, port=0, autostart=False)
    assert not hasattr(node, "port")
    assert change(ros, node, Transition.TRANSITION_CONFIGURE)
    with socket.create_connection(("127.0.0.1", node.port), timeout=5.0):
        pass
    assert change(ros, node, Transition.TRANSITION_CLEANUP)
    with pytest.raises(OSError):
        socket.create_connection(("127.0.0.1", node.port), timeout=5.0)


def test_a_port_in_use_leaves_it_unconfigured_or_ends_the_start(ros):
    first = ros.add(BridgeNode, port=0)
    with pytest.raises(PortInUseError):
        ros.add(BridgeNode, port=first.port)
    other = partial(BridgeNode, namespace="other")  # else both have the same services
    second = ros.add(other, port=first.port, autostart=False)
    assert not change(ros, second, Transition.TRANSITION_CONFIGURE)
    first.cleanup()
    assert change(ros, second, Transition.TRANSITION_CONFIGURE)


def test_odometry_has_a_yaw_rate_and_covariances(ros, bridge):
    heard: list[Odometry] = []
    bridge.decider.create_subscription(Odometry, topics.ODOMETRY, heard.append, qos.FRAME)
    assert ros.spin_until(lambda: bridge.node.count_subscribers(topics.ODOMETRY) > 0)
    wires = [telemetry(sim_time=1.0 + 0.04 * n, pose=Pose(100.0, 80.0, 0.02 * n)) for n in (0, 1)]
    answers_to(ros, bridge.port, *wires)
    assert ros.spin_until(lambda: len(heard) == 2)
    assert [each.twist.twist.angular.z for each in heard] == pytest.approx([0.0, 0.5], abs=1e-3)
    assert all(heard[0].pose.covariance[7 * axis] > 0.0 for axis in range(6))
    assert all(heard[0].twist.covariance[7 * axis] > 0.0 for axis in range(6))
