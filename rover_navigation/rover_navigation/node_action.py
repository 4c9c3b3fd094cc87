"""The action navigate_to_pose, as Nav2 serves it."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

from nav2_msgs.action import NavigateToPose
from rclpy.action import CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node

from rover_common import topics
from rover_common.burger import BURGER
from rover_common.frames import Frames
from rover_common.ros.actions import DeferringActionServer
from rover_common.ros.message_checks import check_pose
from rover_common.ros.message_errors import FrameError, MessageError, NotFiniteError
from rover_common.ros.transforms import pose_of_message
from rover_navigation.conversions import feedback_of, result_of
from rover_navigation.embedded_goal import EmbeddedGoal
from rover_navigation.embedded_navigator import EmbeddedNavigator, NavigatorOutput
from rover_navigation.navigator import GoalStatus


@dataclass(frozen=True)
class _Run:
    """One accepted goal."""

    handle: ServerGoalHandle
    goal: EmbeddedGoal
    begun: int  # [ns] of the node's clock


class NavigateServer:
    """One goal at a time: a newer one takes its place, and the one before it is aborted."""

    def __init__(
        self, node: Node, navigator: EmbeddedNavigator, tolerance: float, frames: Frames
    ) -> None:
        self._node = node
        self._frames = frames
        self._navigator = navigator
        self._tolerance = tolerance
        self._run: _Run | None = None
        self._server = DeferringActionServer(
            node,
            NavigateToPose,
            topics.NAVIGATE,
            goal_callback=self._on_request,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=self._on_cancel,
        )

    def report(self, output: NavigatorOutput) -> None:
        """Feedback or result of a step; exactly one of them for a goal that was there before it."""
        self.settle()
        if self._run is not None:
            run = self._run
            speed = BURGER.cruise_speed
            feedback = feedback_of(output, run.goal, run.begun, speed, self._frames)
            run.handle.publish_feedback(feedback)

    def settle(self) -> None:
        """End the action's goal when the navigator's own has ended."""
        run = self._run
        if run is None or not run.goal.status.final:
            return
        self._run = None
        status, reason = run.goal.status, run.goal.reason
        if status is GoalStatus.REACHED:
            run.handle.succeed()
        elif run.handle.is_cancel_requested:
            run.handle.canceled()
        else:
            run.handle.abort()
        self._node.get_logger().info(f"goal {status.value}{reason and ': '}{reason}")
        failed = status is GoalStatus.FAILED
        self._server.answer(run.handle, result_of(reason, failed))

    def destroy(self) -> None:
        """Abort the goal, and end the server."""
        if self._run is not None and self._node.context.ok():
            self._run.handle.abort()
        self._run = None
        self._server.destroy()

    def _on_request(self, goal: NavigateToPose.Goal) -> GoalResponse:
        frame, wanted = goal.pose.header.frame_id, self._frames.map
        try:
            with suppress(NotFiniteError):  # that ends it with a result
                check_pose(goal.pose)
            if frame not in ("", wanted):
                raise FrameError(f"it is in {frame}, not in {wanted}")
        except MessageError as error:
            self._node.get_logger().warning(f"goal rejected: {error}")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _on_accepted(self, handle: ServerGoalHandle) -> None:
        pose = pose_of_message(handle.request.pose)
        goal = self._navigator.go_to(pose, self._tolerance)  # which ends the one before
        self.settle()
        handle.execute()
        self._run = _Run(handle, goal, self._node.get_clock().now().nanoseconds)
        text = f"goal ({pose.x:.2f}, {pose.y:.2f}) m, {pose.yaw:.2f} rad"
        self._node.get_logger().info(text)
        self.settle()  # what cannot be driven to

    def _on_cancel(self, handle: ServerGoalHandle) -> CancelResponse:
        if self._run is not None and self._run.handle.goal_id == handle.goal_id:
            self._run.goal.cancel()
        # It counts as canceling from the answer on, and must end where no sensor speaks as well.
        if self._node.executor is not None:
            self._node.executor.create_task(self.settle)
        return CancelResponse.ACCEPT
