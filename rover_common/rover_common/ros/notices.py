"""Log lines about what may happen with every message."""

from __future__ import annotations

import time

from rclpy.node import Node

from rover_common.trouble_log import TroubleLog


class Notices:
    """Warns of each trouble as it begins, wherever in the code it is noticed."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._troubles = TroubleLog()

    def warn(self, about: str, text: str) -> None:
        """Log the text, unless a trouble of this name lasts already."""
        if self._troubles.begins(about, time.monotonic()):
            self._node.get_logger().warning(text)

    def end(self, about: str, text: str) -> None:
        """Log that what a trouble hindered works again, and how long it lasted, once."""
        lasted = self._troubles.ends(about, time.monotonic())
        if lasted is not None:
            self._node.get_logger().info(f"{text}, after {lasted:.1f} s")
