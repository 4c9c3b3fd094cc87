"""The client of navigate_to_pose, through all that a server may do."""

from __future__ import annotations

import math
from typing import Any

import pytest
from action_msgs.srv import CancelGoal
from nav2_msgs.action import NavigateToPose
from rclpy.action import ActionClient
from stand_in_nav2 import StandInNav2

from rover_common import frames, topics
from rover_common.geometry import Pose
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.transforms import pose_message_of
from rover_navigation.navigator import GoalStatus
from rover_navigation.node_client import AGAIN, ActionNavigator
from rover_navigation.reported_goal import ReportedGoal

TICK = 50_000_000  # [ns]
HERE, THERE = Pose(1.0, 2.0, 0.5), Pose(-1.0, 0.0, 0.0)


class Client:
    """A mission's tick by hand."""

    def __init__(self, ros: Any, server: StandInNav2) -> None:
        self.ros, self.server = ros, server
        self.node = ros.add(lambda **kwargs: CheckedNode("mission", **kwargs))
        self.navigator = ActionNavigator(self.node)
        self.stamp = 1_000_000_000
        self.until(lambda: self.navigator.is_present)
        self.tick()

    def until(self, predicate: Any) -> None:
        assert self.ros.spin_until(predicate)

    def tick(self) -> bool:
        """Whether the navigator is ready at the next tick."""
        self.stamp += TICK
        self.navigator.update(self.stamp)
        return self.navigator.is_ready

    def driving(self, pose: Pose = HERE) -> ReportedGoal:
        """A goal that the server has taken and speaks of."""
        count = len(self.server.goals)
        goal = self.navigator.go_to(pose, 0.1)
        self.until(lambda: len(self.server.goals) > count and self.navigator.settled)
        self.server.report(2.0)
        self.until(lambda: goal.status is GoalStatus.DRIVING)
        return goal

    def ended(self, goal: ReportedGoal) -> tuple[GoalStatus, str]:
        self.until(lambda: goal.status.final)
        return goal.status, goal.reason


@pytest.fixture
def server(ros) -> StandInNav2:
    return ros.add(StandInNav2)


@pytest.fixture
def client(ros, server):
    client = Client(ros, server)
    yield client
    client.navigator.destroy()


def send_as_somebody_else(client: Client, pose: Pose) -> ActionClient:
    other = ActionClient(client.node, NavigateToPose, topics.NAVIGATE)
    client.until(other.server_is_ready)
    count = len(client.server.goals)
    other.send_goal_async(NavigateToPose.Goal(pose=pose_message_of(0, frames.MAP, pose)))
    client.until(lambda: len(client.server.goals) > count)
    return other


def test_a_goal_is_accepted_driven_to_and_reached(client, server):
    goal = client.navigator.go_to(HERE, 0.1)
    assert (goal.status, goal.distance_left) == (GoalStatus.ACCEPTED, math.inf)
    client.until(lambda: server.active)
    assert server.newest == (HERE.x, HERE.y)
    assert server.goals[0].pose.header.frame_id == frames.MAP
    server.report(1.5)
    client.until(lambda: goal.status is GoalStatus.DRIVING)
    assert (goal.distance_left, goal.recovering) == (1.5, False)
    server.report(1.5, recoveries=1)
    client.until(lambda: goal.recovering)
    server.report(0.0, recoveries=1)
    client.until(lambda: math.isinf(goal.distance_left))  # no path, and no new recovery
    assert not goal.recovering
    server.succeed()
    assert client.ended(goal) == (GoalStatus.REACHED, "")
    assert client.tick()


def test_a_rejected_goal_has_failed(client, server):
    server.rejects = True
    goal = client.navigator.go_to(HERE, 0.1)
    assert client.ended(goal) == (GoalStatus.FAILED, "rejected by the navigator")
    assert client.tick()


@pytest.mark.parametrize(
    ("code", "text", "reason"),
    [
        (208, "no valid path", "no valid path"),
        (208, "", "aborted by the navigator, error 208"),
        (0, "", "aborted by the navigator, error 0"),
    ],
)
def test_an_aborted_goal_has_failed_with_the_reason(client, server, code, text, reason):
    goal = client.driving()
    server.abort(code, text)
    assert client.ended(goal) == (GoalStatus.FAILED, reason)


def test_our_own_newer_goal_cancels_the_one_before_and_is_driven_to(client, server):
    first = client.driving(HERE)
    second = client.driving(THERE)
    assert client.ended(first) == (GoalStatus.CANCELLED, "replaced by another goal")
    assert server.newest == (THERE.x, THERE.y)
    server.succeed()
    assert client.ended(second) == (GoalStatus.REACHED, "")
    assert first.status is GoalStatus.CANCELLED


def test_somebody_elses_goal_is_no_failure_of_ours(client):
    goal = client.driving()
    other = send_as_somebody_else(client, THERE)
    assert client.ended(goal) == (GoalStatus.CANCELLED, "replaced by somebody else's goal")
    other.destroy()


def test_a_goal_that_somebody_else_cancels_is_cancelled(client, server):
    goal = client.driving()
    cancel_all(client)
    assert client.ended(goal) == (GoalStatus.CANCELLED, "canceled by somebody else")
    assert server.canceled == 1


def cancel_all(client: Client) -> None:
    """An empty request means all goals."""
    service = client.node.create_client(CancelGoal, f"{topics.NAVIGATE}/_action/cancel_goal")
    client.until(service.service_is_ready)
    service.call_async(CancelGoal.Request())


def test_our_own_cancellation_counts_at_once_and_the_server_is_told(client, server):
    goal = client.driving()
    goal.cancel()
    assert (goal.status, client.navigator.settled) == (GoalStatus.CANCELLED, False)
    client.until(lambda: server.canceled == 1 and client.navigator.settled)
    assert not server.active
    assert client.tick()


def test_a_goal_that_is_given_up_before_it_was_accepted_is_canceled_all_the_same(client, server):
    """Also by a server to which the cancellation came before the goal."""
    server.deaf = 1
    goal = client.navigator.go_to(HERE, 0.1)
    goal.cancel()
    client.until(lambda: server.goals and client.navigator.settled)
    for _ in range(3):
        client.tick()
    client.until(lambda: server.canceled == 1)
    assert not server.active


def test_a_server_that_stalls_is_not_ready_until_it_speaks_again(client, server):
    goal = client.driving()
    assert client.tick()
    assert not client.tick()
    server.report(1.0)
    client.until(lambda: goal.distance_left == 1.0)
    assert client.tick()
    assert client.navigator.is_present


def test_a_server_that_does_not_answer_a_goal_is_not_ready(client, server):
    client.ros.executor.remove_node(server)  # it lives, and does nothing
    goal = client.navigator.go_to(HERE, 0.1)
    assert client.tick()
    assert not client.tick()
    client.ros.executor.add_node(server)
    client.until(lambda: server.goals and client.navigator.settled)
    server.report(1.0)
    client.until(lambda: goal.status is GoalStatus.DRIVING)
    assert client.tick()


def test_a_server_that_dies_and_comes_back_is_ready_and_takes_the_goal_again(client, server):
    goal = client.driving()
    server.die()
    client.until(lambda: not client.navigator.is_present)
    assert not client.tick()
    goal.cancel()
    assert not client.navigator.settled
    server.come_back()
    client.until(lambda: client.navigator.is_present)
    client.stamp += AGAIN
    client.tick()
    client.until(lambda: client.navigator.settled)
    assert client.tick()
    assert client.driving(HERE).status is GoalStatus.DRIVING


def test_a_goal_that_a_new_server_does_not_know_is_cancelled(ros, other_ros):
    """The old one has accepted it, and died before it was asked for the result."""
    server = other_ros.add(StandInNav2)
    client = Client(ros, server)
    goal = client.navigator.go_to(HERE, 0.1)
    assert other_ros.spin_until(lambda: server.active)
    server.die()
    server.come_back()

    def ended() -> bool:
        other_ros.executor.spin_once(timeout_sec=0.0)
        return goal.status.final

    client.until(ended)
    assert goal.status is GoalStatus.CANCELLED
    assert goal.reason == "the navigator does not know it any more"
    client.navigator.destroy()
