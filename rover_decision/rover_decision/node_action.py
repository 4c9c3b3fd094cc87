"""The action ~/run_mission of a mission's node: a mission as a goal, with feedback."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rclpy.action import CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node
from rover_interfaces.action import RunMission

from rover_common.ros.actions import DeferringActionServer
from rover_decision.core import DecisionCore
from rover_decision.mission_goal import REASONS, MissionGoal, Outcome, refusal


class RunMissionServer:
    """Takes one goal at a time and ends it from the mission's reports."""

    def __init__(
        self,
        node: Node,
        core: DecisionCore,
        action: Any = RunMission,
        reasons: Mapping[Outcome, str] = REASONS,
    ) -> None:
        """action: of the mission; reasons: what a result says of each outcome."""
        self._node = node
        self._action, self._reasons = action, reasons
        self._report_type = type(action.Feedback().mission)
        self._core = core
        self._goal: MissionGoal | None = None
        self._handle: ServerGoalHandle | None = None  # of that goal
        self._report = self._report_type()  # the last one
        self._server = DeferringActionServer(
            node,
            action,
            "~/run_mission",
            goal_callback=self._on_request,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=self._on_cancel,
        )

    def on_report(self, report: Any) -> None:
        """Pass a report of the mission on, or end the goal with it."""
        if self._goal is not None and self._goal.outcome() is Outcome.RESTARTED:
            self.settle()  # with what was last reported of the mission before
        self._report = report
        self.settle()
        if self._handle is not None:
            self._handle.publish_feedback(self._action.Feedback(mission=report))

    def settle(self) -> None:
        """End the goal when its mission has ended."""
        outcome = self._goal.outcome() if self._goal is not None else None
        handle = self._handle
        if outcome is None or handle is None:
            return
        match outcome:
            case Outcome.HOME:
                handle.succeed()
            case Outcome.CANCELED:
                handle.canceled()
            case Outcome.RESTARTED | Outcome.FAILED:
                handle.abort()
        self._goal, self._handle = None, None
        self._node.get_logger().info(f"run_mission: {self._reasons[outcome]}")
        result = self._action.Result(
            outcome=int(outcome), reason=self._reasons[outcome], mission=self._report
        )
        self._server.answer(handle, result)

    def destroy(self) -> None:
        """Abort the goal, and end the server."""
        if self._handle is not None and self._node.context.ok():
            self._handle.abort()
        self._goal, self._handle = None, None
        self._server.destroy()

    def _on_request(self, goal: Any) -> GoalResponse:
        why_not = refusal(goal.time_limit, self._goal)
        if why_not:
            self._node.get_logger().warning(f"run_mission: rejected: {why_not}")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _on_accepted(self, handle: ServerGoalHandle) -> None:
        self._handle = handle
        self._goal = MissionGoal(self._core, handle.request.time_limit)
        if self._core.mission.idle:
            self._report = self._report_type(state_name=self._core.state.name)
        self._node.get_logger().info(f"run_mission: accepted: {self._core.state.name}")
        handle.execute()

    def _on_cancel(self, _: ServerGoalHandle) -> CancelResponse:
        if self._goal is not None:
            self._goal.cancel()
            self._node.get_logger().info(f"run_mission: canceled: {self._core.state.name}")
        # The goal counts as canceling from the answer on; where no frames come it must end as well.
        if self._node.executor is not None:
            self._node.executor.create_task(self.settle)
        return CancelResponse.ACCEPT
