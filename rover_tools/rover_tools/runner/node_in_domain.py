"""A node of this process in a DDS domain of its choice, beside the processes of a run."""

from __future__ import annotations

from types import TracebackType
from typing import Self

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor

from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.fast_dds import use_profiles


class NodeInDomain:
    """Owns a context, a node and its executor; all of them end with the `with` block."""

    def __init__(self, name: str, domain_id: int) -> None:
        use_profiles()
        self.context = Context()
        rclpy.init(context=self.context, args=[], domain_id=domain_id)
        self.node = CheckedNode(name, context=self.context, enable_rosout=False)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        self.context.try_shutdown()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()
