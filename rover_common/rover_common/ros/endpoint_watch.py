"""Says when a subscription cannot receive what is published on its topic."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.qos import QoSCompatibility, qos_check_compatible
from rclpy.subscription import Subscription

from rover_common.ros.diagnostics import NodeDiagnostics

LOOK, LOOKS = 1.0, 5  # [s] of wall time, and how many of them lie between two checks
PROBLEM = "subscriptions"  # name in the diagnostics


class EndpointWatch:
    """Checks type and quality of service of all publishers, 1 s after the start and every 5 s."""

    def __init__(
        self, node: Node, diagnostics: NodeDiagnostics, subscriptions: Iterable[Subscription]
    ) -> None:
        self._node = node
        self._diagnostics = diagnostics
        self._subscriptions = tuple(subscriptions)
        self._said: set[str] = set()
        self._looks = 0
        self._timer = node.create_timer(
            LOOK, self._look, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )

    def check(self) -> list[str]:
        """What does not fit, a line each; a new one is logged as an error."""
        lines = [line for each in self._subscriptions for line in self._problems(each)]
        for line in set(lines) - self._said:
            self._node.get_logger().error(line)
        self._said = set(lines)
        self._diagnostics.set_error(PROBLEM, "; ".join(lines))
        return lines

    def _look(self) -> None:
        if self._looks % LOOKS == 0:
            self.check()
        self._looks += 1

    def _problems(self, subscription: Subscription) -> Iterable[str]:
        name: str = subscription.topic_name
        kind: Any = subscription.msg_type
        wanted = f"{kind.__module__.split('.')[0]}/msg/{kind.__name__}"
        for publisher in self._node.get_publishers_info_by_topic(name):
            if publisher.topic_type != wanted:
                yield f"{name}: {publisher.node_name} sends {publisher.topic_type}, not {wanted}"
                continue
            fits, why = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)
            if fits == QoSCompatibility.ERROR:
                yield f"{name}: nothing of {publisher.node_name} is received: {why}"
