"""The action ~/run_mission, over the wire, with frames by hand."""

from __future__ import annotations

from typing import Any

import pytest
from action_msgs.msg import GoalStatus
from frames_by_hand import AWAY
from node_bench import PERIOD, NodeBench
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Future
from rover_interfaces.action import RunMission

from rover_common.ros.runner import EventsExecutor


class ActionBench(NodeBench):
    """With a client of the action."""

    def __init__(self, ros: Any) -> None:
        super().__init__(ros)
        self.client = ActionClient(self.peer, RunMission, "decision_node/run_mission")
        self.feedback: list[RunMission.Feedback] = []
        assert ros.spin_until(self.client.server_is_ready)

    def wait(self, future: Future) -> Any:
        assert self.ros.spin_until(future.done)
        return future.result()

    def send_goal(self, time_limit: float = 0.0) -> Any:
        """Send a goal; returns its handle, accepted or not."""
        goal = RunMission.Goal(time_limit=time_limit)
        return self.wait(
            self.client.send_goal_async(
                goal, lambda message: self.feedback.append(message.feedback)
            )
        )

    def accepted(self, time_limit: float = 0.0) -> tuple[Any, Future]:
        """Send a goal that is accepted; returns its handle and its result to come."""
        handle = self.send_goal(time_limit)
        assert handle.accepted
        return handle, handle.get_result_async()

    def cancel(self, handle: Any) -> None:
        assert len(self.wait(handle.cancel_goal_async()).goals_canceling) == 1

    def doing(self) -> str:
        """The state that was last fed back."""
        return self.feedback[-1].mission.state_name if self.feedback else ""

    def end_of(self, result: Future) -> tuple[int, int]:
        """The goal's status and its outcome, when it has ended."""
        response = self.wait(result)
        return response.status, response.result.outcome


@pytest.fixture(params=[SingleThreadedExecutor, EventsExecutor], ids=["single", "events"])
def bench(ros, request):
    """With the executor of the tests, and with the one that the node runs on."""
    ros.executor.shutdown()
    ros.executor = request.param(context=ros.context)
    bench = ActionBench(ros)
    yield bench
    bench.client.destroy()


HOME = (GoalStatus.STATUS_SUCCEEDED, RunMission.Result.HOME)
CANCELED = (GoalStatus.STATUS_CANCELED, RunMission.Result.CANCELED)
RESTARTED = (GoalStatus.STATUS_ABORTED, RunMission.Result.RESTARTED)


def test_a_goal_is_followed_with_feedback_until_the_rover_is_home(ros, bench):
    handle, result = bench.accepted(time_limit=2.0)
    assert ros.spin_until(lambda: handle.status == GoalStatus.STATUS_EXECUTING)
    bench.frame()
    bench.frame(pose=AWAY, sample_count=2)
    assert not result.done()
    while bench.doing() != "RETURN_HOME":
        assert bench.time < 5.0
        bench.frame(pose=AWAY, sample_count=2)
    bench.frame(sample_count=2)
    assert bench.end_of(result) == HOME
    assert bench.feedback[0].mission.state_name == "FORWARD"
    assert bench.feedback[-1].mission.home_distance == pytest.approx(2.5)
    last = result.result().result.mission
    assert (last.state_name, last.samples_collected, last.home_distance) == ("DONE", 1, 0.0)
    assert last.distance == pytest.approx(5.0)
    assert last.elapsed == pytest.approx(bench.time - (1.0 + PERIOD))


def test_a_mission_that_runs_already_is_followed(bench):
    for _ in range(3):
        bench.frame()
    _, result = bench.accepted()
    bench.frame()
    assert bench.call("return_home").success
    bench.frame()
    assert bench.end_of(result) == HOME
    assert result.result().result.mission.elapsed == pytest.approx(4 * PERIOD)


def test_a_canceled_goal_ends_when_the_rover_is_home(ros, bench):
    bench.frame()
    handle, result = bench.accepted()
    bench.frame(pose=AWAY)
    bench.cancel(handle)
    bench.frame(pose=AWAY)
    assert ros.spin_until(lambda: bench.doing() == "RETURN_HOME")
    assert ros.spin_until(lambda: handle.status == GoalStatus.STATUS_CANCELING)
    assert not result.done()
    bench.frame()
    assert bench.end_of(result) == CANCELED
    assert result.result().result.mission.state_name == "DONE"


def test_a_goal_canceled_before_the_first_frame_ends_at_once(bench):
    handle, result = bench.accepted()
    bench.cancel(handle)
    assert bench.end_of(result) == CANCELED
    assert result.result().result.mission.state_name == "IDLE"


def test_a_second_goal_is_rejected_and_the_first_goes_on(bench):
    bench.frame()
    first, result = bench.accepted()
    assert not bench.send_goal().accepted
    bench.cancel(first)
    assert not bench.send_goal().accepted
    bench.frame()
    assert bench.end_of(result) == CANCELED
    assert not bench.send_goal(time_limit=-1.0).accepted
    assert bench.send_goal().accepted


def test_a_goal_starts_a_mission_that_is_over_again_with_a_new_run(bench):
    results = []
    for _ in range(2):
        _, result = bench.accepted()
        if results:
            assert bench.frame(sample_count=2).new_run
            bench.begin_run()
        bench.frame(sample_count=3 - len(results))
        bench.call("return_home")
        bench.frame(sample_count=3 - len(results))
        assert bench.end_of(result) == HOME
        results.append(result.result().result.mission)
    assert [mission.run for mission in results] == [1, 2]
    assert [mission.samples_total for mission in results] == [3, 2]
    assert results[1].elapsed == pytest.approx(PERIOD)


def test_a_reset_and_a_new_run_abort_the_goal(bench):
    bench.frame()
    _, result = bench.accepted()
    bench.frame(pose=AWAY)
    assert bench.call("reset").success
    assert bench.end_of(result) == RESTARTED
    assert bench.frame().new_run
    bench.begin_run()
    bench.frame()
    _, result = bench.accepted()
    bench.frame(pose=AWAY)
    bench.begin_run()
    bench.frame()
    assert bench.end_of(result) == RESTARTED
    last = result.result().result.mission
    assert (last.state_name, last.run) == ("FORWARD", 2)
    bench.frame()


def test_the_node_ends_while_a_goal_is_active(ros, bench):
    bench.frame()
    handle, result = bench.accepted()
    bench.frame(pose=AWAY)
    ros.nodes.remove(bench.node)
    ros.executor.remove_node(bench.node)
    bench.node.destroy_node()
    assert ros.spin_until(lambda: handle.status == GoalStatus.STATUS_ABORTED)
    assert ros.spin_until(lambda: not bench.client.server_is_ready())
    result.cancel()
