"""Counters of a node, published as /diagnostics."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from rover_common.ros import qos

PERIOD = 0.25  # [s] between checks; published once a second, and at once when the level changes
CHECKS_PER_PUBLISH = 4


class NodeDiagnostics:
    """Publishes the node's counters and whether its peers are connected.

    `peers` maps a peer's name to a function that tells whether it is connected; until all are, the
    level is WARN. `counts` is the node's own: count events with `diagnostics.counts["name"] += 1`.
    It is that of a CheckedNode, with what it refused. Other troubles are set by name, and taken
    away with an empty text.
    """

    def __init__(self, node: Node, peers: Mapping[str, Callable[[], bool]]) -> None:
        own: Counter[str] | None = getattr(node, "counts", None)  # of a CheckedNode
        self.counts = Counter[str]() if own is None else own
        self._node = node
        self._peers = dict(peers)
        self._level: Any = None
        self._checks = 0
        self._warnings: dict[str, str] = {}
        self._errors: dict[str, str] = {}
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        # Wall time: it must go on while the simulated clock stands still.
        self._timer = node.create_timer(
            PERIOD, self._check, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )

    def set_warning(self, name: str, text: str) -> None:
        """Something that a person should know; an empty text ends it."""
        self._warnings[name] = text

    def set_error(self, name: str, text: str) -> None:
        """Something that keeps the node from its work; an empty text ends it."""
        self._errors[name] = text

    def _check(self) -> None:
        missing = [name for name, connected in self._peers.items() if not connected()]
        errors = list(filter(None, self._errors.values()))
        texts = errors + list(filter(None, self._warnings.values()))
        texts += ["waiting for " + ", ".join(missing)] if missing else []
        level = DiagnosticStatus.WARN if texts else DiagnosticStatus.OK
        level = DiagnosticStatus.ERROR if errors else level
        self._checks += 1
        if level != self._level or self._checks >= CHECKS_PER_PUBLISH:
            self._checks = 0
            self._level = level
            self._publish(level, texts)

    def _publish(self, level: Any, texts: list[str]) -> None:
        message = DiagnosticArray()
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.status = [
            DiagnosticStatus(
                level=level,
                name=self._node.get_fully_qualified_name(),
                message="; ".join(texts) or "connected",
                values=[KeyValue(key=k, value=str(v)) for k, v in sorted(self.counts.items())],
            )
        ]
        self._publisher.publish(message)
