"""The times of a node's ticks, and what /diagnostics says of them."""

from __future__ import annotations

from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.node import Node

from rover_common.ros import qos
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.tick_times import TickTimes


def test_mean_and_longest_since_the_last_look():
    moments = iter([0.0, 1.0, 5.0, 8.0, 10.0, 10.5])
    ticks = TickTimes(lambda: next(moments))
    assert ticks.take() is None
    for _ in range(2):
        with ticks:
            pass
    assert ticks.take() == (2.0, 3.0)
    with pytest.raises(ValueError), ticks:
        raise ValueError
    assert ticks.take() == (0.5, 0.5)
    assert ticks.take() is None


def test_a_node_tells_its_state_and_the_times_of_its_ticks(ros):
    node = ros.add(lambda **kwargs: Node("worker", **kwargs))
    heard: list[Any] = []
    node.create_subscription(DiagnosticArray, "/diagnostics", heard.append, qos.DIAGNOSTICS)
    diagnostics = NodeDiagnostics(node, {})

    def values() -> dict[str, str]:
        return {pair.key: pair.value for pair in heard[-1].status[0].values} if heard else {}

    assert ros.spin_until(lambda: heard)
    assert values() == {}
    diagnostics.counts["frames"] += 1
    diagnostics.state = "FORWARD"
    with diagnostics.ticks:
        sum(range(100_000))
    assert ros.spin_until(lambda: values().get("state") == "FORWARD")
    told = values()
    assert told["frames"] == "1"
    assert 0.0 < float(told["tick time [ms]"]) <= float(told["longest tick [ms]"])
    heard.clear()  # without another tick, the last ones stay
    assert ros.spin_until(lambda: heard)
    assert values() == told
