"""Which publishers know of this node's subscriptions."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.node import Node

from rover_common.ros import qos

DIAGNOSTICS = "/diagnostics"


class KnownListener:
    """Hears who reports to /diagnostics.

    A node that has found a publisher is not found by it at the same moment: what that publishes
    meanwhile is lost, for seconds on a busy machine. DDS announces subscriptions in their order, so
    whoever is heard through this one knows of those that were made before it.
    """

    def __init__(self, node: Node) -> None:
        """Make it after all subscriptions that it is to tell of."""
        self._node = node
        self._heard: set[str] = set()
        node.create_subscription(
            DiagnosticArray, DIAGNOSTICS, self._on_diagnostics, qos.DIAGNOSTICS
        )

    def known_by_publishers(self, topic: str) -> bool:
        """Whether all that publish a topic know; of one without reports nothing can be said."""
        publishing, reporting = self._publishers(topic), self._publishers(DIAGNOSTICS)
        return publishing & reporting <= self._heard

    def _publishers(self, topic: str) -> set[str]:
        """Their nodes' names."""
        found = self._node.get_publishers_info_by_topic(topic)
        return {f"{each.node_namespace.rstrip('/')}/{each.node_name}" for each in found}

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self._heard.update(status.name.partition(": ")[0] for status in message.status)
