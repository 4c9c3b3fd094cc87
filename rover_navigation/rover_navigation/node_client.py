"""The action navigate_to_pose as a `Navigator`: Nav2's, or that of navigator_node."""

from __future__ import annotations

import uuid
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from action_msgs.msg import GoalInfo, GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from nav2_msgs.action import NavigateToPose
from rclpy.action import ActionClient
from rclpy.qos import qos_profile_action_status_default
from rclpy.task import Future
from unique_identifier_msgs.msg import UUID

from rover_common import topics
from rover_common.frames import MAP
from rover_common.geometry import Pose
from rover_common.ros.checked_node import CheckedNode, Entrance
from rover_common.ros.conversions import stamp_of
from rover_common.ros.transforms import pose_message_of
from rover_navigation.conversions import check_feedback
from rover_navigation.navigator import GoalStatus as Status
from rover_navigation.reported_goal import ReportedGoal

AGAIN = 500_000_000  # [ns] after which what is not answered is asked again
FEEDBACK = f"{topics.NAVIGATE}/_action/feedback"
ACTIVE = (GoalStatus.STATUS_ACCEPTED, GoalStatus.STATUS_EXECUTING)


@dataclass
class _Request:
    """A goal, or a goal's cancellation, that was sent."""

    goal_id: UUID
    asked: int  # [ns]
    future: Future | None = None  # of a cancellation; None while it could not be sent
    updates: int = 0  # that it has waited for its answer


@dataclass
class _Sent:
    """The newest goal."""

    goal_id: UUID
    reported: ReportedGoal
    feedback_stamp: int = 0  # [ns] of the newest feedback
    request: _Request | None = None  # until it is answered


@dataclass
class ActionNavigator:
    """`update` once a tick, before goals are asked for. It is ready while it answers.

    A server that dies leaves no word: its goals get no feedback any more, its requests no answer.
    What is given up is canceled until somebody answers, as a server that was started anew does.
    """

    node: CheckedNode
    on_heard: Callable[[], None] = lambda: None  # called when the server has said something
    map_frame: str = MAP  # of the goals
    is_ready: bool = False
    _sent: _Sent | None = None
    _cancels: dict[bytes, _Request] = field(default_factory=dict)
    _heard: bool = False  # since the last update
    _now: int = 0  # [ns] of the last update
    _others: bool = False  # somebody else's goal is active

    def __post_init__(self) -> None:
        self._client = ActionClient(self.node, NavigateToPose, topics.NAVIGATE)
        self._cancel_client = self.node.create_client(
            CancelGoal, f"{topics.NAVIGATE}/_action/cancel_goal"
        )
        self.node.create_subscription(
            GoalStatusArray,
            f"{topics.NAVIGATE}/_action/status",
            self._on_statuses,
            qos_profile_action_status_default,
        )

    @property
    def is_present(self) -> bool:
        """Whether there is a server."""
        return bool(self._client.server_is_ready())

    @property
    def settled(self) -> bool:
        """Whether all that was asked has been answered."""
        return not self._requests()

    def told_about(self, stamp: int) -> bool:
        """Whether there is feedback of a tick [ns], where there is a goal."""
        sent = self._sent
        return sent is None or sent.reported.status.final or sent.feedback_stamp >= stamp

    def go_to(self, pose: Pose, tolerance: float) -> ReportedGoal:
        """The tolerance is the server's own, for the action has none."""
        if self._sent is not None:
            self._sent.reported.end(Status.CANCELLED, "replaced by another goal")
        goal_id = UUID(uuid=list(uuid.uuid4().bytes))
        sent = _Sent(goal_id, ReportedGoal(lambda: self._give_up(sent)))
        sent.request = _Request(goal_id, self._now)
        self._sent = sent
        heard = Entrance(
            self.node, FEEDBACK, lambda said: self._on_feedback(sent, said), check_feedback
        )
        future = self._client.send_goal_async(
            NavigateToPose.Goal(pose=pose_message_of(self._now, self.map_frame, pose)),
            lambda message: heard(message.feedback),
            goal_id,
        )
        future.add_done_callback(lambda future: self._on_answer(sent, future.result()))
        return sent.reported

    def update(self, stamp: int) -> None:
        """A tick [ns] begins."""
        self._now = stamp
        late = False
        for request in self._requests():
            request.updates += 1
            late |= request.updates > 1
        driving = self._sent is not None and not self._sent.reported.status.final
        waiting = driving and self._sent is not None and self._sent.request is not None
        silent = driving and not waiting and not self._heard
        self.is_ready = self.is_present and not late and not silent
        self._heard = False
        for request in self._cancels.values():
            if request.future is None or stamp - request.asked >= AGAIN:
                self._ask_to_cancel(request)

    def destroy(self) -> None:
        """End the client."""
        self._client.destroy()

    def _requests(self) -> list[_Request]:
        goal = self._sent.request if self._sent is not None else None
        return [*self._cancels.values(), *([goal] if goal is not None else [])]

    def _on_answer(self, sent: _Sent, handle: Any) -> None:
        """The server has accepted or rejected the goal."""
        sent.request = None
        if not handle.accepted:
            sent.reported.end(Status.FAILED, "rejected by the navigator")
        elif sent.reported.status.final and self._sent is sent:
            self._give_up(sent)  # it was given up before this answer
        else:
            result = handle.get_result_async()
            result.add_done_callback(lambda future: self._on_result(sent, future.result()))
        self._note_heard()

    def _on_feedback(self, sent: _Sent, feedback: NavigateToPose.Feedback) -> None:
        sent.feedback_stamp = stamp_of(feedback.current_pose.header.stamp)
        sent.reported.report(feedback.distance_remaining, feedback.number_of_recoveries)
        self._note_heard()

    def _on_result(self, sent: _Sent, answer: Any) -> None:
        status, result = answer.status, answer.result
        if status == GoalStatus.STATUS_SUCCEEDED:
            sent.reported.end(Status.REACHED)
        elif status == GoalStatus.STATUS_CANCELED:
            sent.reported.end(Status.CANCELLED, "canceled by somebody else")
        elif status != GoalStatus.STATUS_ABORTED:
            sent.reported.end(Status.CANCELLED, "the navigator does not know it any more")
        elif self._others and result.error_code == result.NONE:
            sent.reported.end(Status.CANCELLED, "replaced by somebody else's goal")
        else:
            reason = result.error_msg or f"aborted by the navigator, error {result.error_code}"
            sent.reported.end(Status.FAILED, reason)
        self._note_heard()

    def _note_heard(self) -> None:
        self._heard = True
        self.on_heard()

    def _on_statuses(self, message: GoalStatusArray) -> None:
        own = b"" if self._sent is None else bytes(self._sent.goal_id.uuid)
        self._others = any(
            each.status in ACTIVE and bytes(each.goal_info.goal_id.uuid) != own
            for each in message.status_list
        )

    def _give_up(self, sent: _Sent) -> None:
        sent.request = None  # the cancellation is what has to be answered now
        request = _Request(sent.goal_id, self._now)
        self._cancels[bytes(sent.goal_id.uuid)] = request
        self._ask_to_cancel(request)

    def _ask_to_cancel(self, request: _Request) -> None:
        if request.future is not None:
            self._cancel_client.remove_pending_request(request.future)
            request.future = None
        if not self._cancel_client.service_is_ready():
            return
        request.asked = self._now
        info = GoalInfo(goal_id=request.goal_id)
        request.future = self._cancel_client.call_async(CancelGoal.Request(goal_info=info))
        request.future.add_done_callback(lambda _: self._on_canceled(request))

    def _on_canceled(self, request: _Request) -> None:
        """Answered, if only that there is no such goal."""
        self._cancels.pop(bytes(request.goal_id.uuid), None)
        self._note_heard()
