"""An action server for nodes that work tick by tick."""

from __future__ import annotations

from typing import Any

from rclpy.action import ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node


class DeferringActionServer(ActionServer):
    """Asks for a goal's result when it is there, instead of executing the goal from its beginning.

    An execute callback that waits for the end would hold up the frames, and a coroutine that awaits
    it is polled by EventsExecutor without a pause, which takes a whole core.
    """

    def __init__(self, node: Node, action_type: Any, name: str, **callbacks: Any) -> None:
        def execute(_: ServerGoalHandle) -> Any:
            return action_type.Result()  # wanted by the base class, never called

        super().__init__(node, action_type, name, execute, **callbacks)

    def notify_execute(self, goal_handle: ServerGoalHandle, execute_callback: Any) -> None:
        """Called by the goal's handle when it has become EXECUTING: nothing to do yet."""

    def answer(self, goal_handle: ServerGoalHandle, result: Any) -> None:
        """Send the result of a goal that has been brought to its last state."""
        super().notify_execute(goal_handle, lambda _: result)
