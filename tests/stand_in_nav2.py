"""A stand-in for Nav2's server of navigate_to_pose: the test says how each goal gets on."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_msgs.action import NavigateToPose
from rclpy.action import CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node

from rover_common import frames, topics
from rover_common.ros.actions import DeferringActionServer
from rover_common.ros.conversions import header_of

Result = NavigateToPose.Result


class StandInNav2(Node):
    """Takes one goal at a time: a newer one aborts the one before with error code 0, as Nav2 does.

    A goal that the test says nothing about stalls: it never ends, without a word of feedback.
    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("bt_navigator", **kwargs)
        self.rejects = False
        self.goals: list[NavigateToPose.Goal] = []  # accepted, in their order
        self.rejected: list[NavigateToPose.Goal] = []
        self.canceled = 0
        self.deaf = 0  # cancellations that it does not carry out
        self._handle: ServerGoalHandle | None = None
        self._server: DeferringActionServer | None = None
        self.come_back()

    def destroy_node(self) -> None:
        self.die()
        super().destroy_node()

    @property
    def active(self) -> bool:
        """Whether it has a goal."""
        return self._handle is not None

    @property
    def newest(self) -> tuple[float, float]:
        """[m] Where the newest accepted goal lies."""
        return place_of(self.goals[-1])

    def die(self) -> None:
        """At once: nobody gets an answer any more."""
        self._handle = None
        if self._server is not None:
            self._server.destroy()
            self._server = None

    def come_back(self) -> None:
        """As a process that was started anew: it knows no goal."""
        self._server = DeferringActionServer(
            self,
            NavigateToPose,
            topics.NAVIGATE,
            goal_callback=self._on_request,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=self._on_cancel,
        )

    def report(self, distance: float, recoveries: int = 0, stamp: int = 0) -> None:
        """Feedback of the goal at hand: [m] left."""
        assert self._handle is not None
        pose = PoseStamped(header=header_of(stamp, frames.MAP))
        feedback = NavigateToPose.Feedback(
            current_pose=pose, distance_remaining=distance, number_of_recoveries=recoveries
        )
        self._handle.publish_feedback(feedback)

    def succeed(self) -> None:
        self._end("succeed", Result())

    def abort(self, error_code: int = 0, error_msg: str = "") -> None:
        self._end("abort", Result(error_code=error_code, error_msg=error_msg))

    def _on_request(self, goal: NavigateToPose.Goal) -> GoalResponse:
        if self.rejects:
            self.rejected.append(goal)
        return GoalResponse.REJECT if self.rejects else GoalResponse.ACCEPT

    def _on_accepted(self, handle: ServerGoalHandle) -> None:
        if self._handle is not None:
            self.abort()
        self.goals.append(handle.request)
        handle.execute()
        self._handle = handle

    def _on_cancel(self, handle: ServerGoalHandle) -> CancelResponse:
        unknown = self._handle is None or self._handle.goal_id != handle.goal_id
        if unknown or self.deaf > 0:
            self.deaf -= not unknown
            return CancelResponse.REJECT
        assert self.executor is not None
        self.executor.create_task(lambda: self._end("canceled", Result()))  # after the answer
        return CancelResponse.ACCEPT

    def _end(self, how: str, result: NavigateToPose.Result) -> None:
        handle, self._handle = self._handle, None
        assert handle is not None
        assert self._server is not None
        self.canceled += how == "canceled"
        getattr(handle, how)()
        self._server.answer(handle, result)


def place_of(goal: NavigateToPose.Goal) -> tuple[float, float]:
    """[m] Where a goal lies."""
    position = goal.pose.pose.position
    return position.x, position.y
