"""The action ~/run_mission, over the wire, with frames by hand."""

from __future__ import annotations

import math
from typing import Any

import pytest
from action_msgs.msg import GoalStatus
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from rover import MIDDLE, snapshot
from rover_interfaces.action import RunMission
from rover_interfaces.msg import DriveCommand, PolarArray, RockTrackArray, RoverStatus
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Trigger

from rover_common import frames, topics
from rover_common.geometry import Pose
from rover_common.ros import conversions, qos
from rover_common.ros.runner import EventsExecutor
from rover_common.types import FIRST_RUN
from rover_decision.node import DecisionNode

PERIOD = 0.3  # [s] of frame time
NEAR = Pose(MIDDLE.x + 2.5, MIDDLE.y, 0.0)  # a step of the rover, but not home any more


class Bench:
    """A decision node, its frames by hand, and a client of its action."""

    def __init__(self, ros: Any) -> None:
        self.ros = ros
        self.node = ros.add(DecisionNode)
        self.peer = ros.add(lambda **kwargs: Node("peer", **kwargs))
        kinds = {
            topics.ODOMETRY: Odometry,
            topics.STATUS: RoverStatus,
            topics.NAV_POLAR: PolarArray,
            topics.FREE_SCAN: LaserScan,
            topics.ROCKS: RockTrackArray,
        }
        self._parts = {
            topic: self.peer.create_publisher(kind, topic, qos.FRAME)
            for topic, kind in kinds.items()
        }
        self._commands: list[DriveCommand] = []
        self.peer.create_subscription(
            DriveCommand, topics.COMMAND, self._commands.append, qos.FRAME
        )
        self.client = ActionClient(self.peer, RunMission, "decision_node/run_mission")
        self.feedback: list[RunMission.Feedback] = []
        self.time = 1.0  # [s] of the last frame
        assert ros.spin_until(self.client.server_is_ready)
        assert ros.spin_until(lambda: self.node.count_subscribers(topics.COMMAND) > 0)
        for part in self._parts.values():
            assert ros.spin_until(lambda part=part: part.get_subscription_count() > 0)

    def frame(self, pose: Pose = MIDDLE, time: float | None = None, **what: Any) -> None:
        """Send a frame and wait for the command that answers it."""
        self.time = self.time + PERIOD if time is None else time
        shown = snapshot(self.time, pose, **what)
        stamp, vehicle = shown.vehicle.stamp, shown.vehicle
        status = RoverStatus(
            header=conversions.header_of(stamp, frames.BASE),
            near_sample=vehicle.near_sample,
            picking_up=vehicle.picking_up,
            sample_count=vehicle.sample_count,
            sim_time=math.nan,
        )
        answered = len(self._commands)
        self._parts[topics.ODOMETRY].publish(conversions.odometry_of(stamp, pose, vehicle.speed))
        self._parts[topics.STATUS].publish(status)
        self._parts[topics.NAV_POLAR].publish(
            conversions.polar_message_of(stamp, FIRST_RUN, shown.nav)
        )
        self._parts[topics.FREE_SCAN].publish(conversions.scan_message_of(stamp, shown.scan))
        self._parts[topics.ROCKS].publish(
            conversions.rocks_message_of(stamp, FIRST_RUN, shown.rocks, 0)
        )
        assert self.ros.spin_until(lambda: len(self._commands) > answered)

    def wait(self, future: Future) -> Any:
        assert self.ros.spin_until(future.done)
        return future.result()

    def send(self, time_limit: float = 0.0) -> Any:
        """Send a goal; returns its handle, accepted or not."""
        goal = RunMission.Goal(time_limit=time_limit)
        return self.wait(
            self.client.send_goal_async(
                goal, lambda message: self.feedback.append(message.feedback)
            )
        )

    def accepted(self, time_limit: float = 0.0) -> tuple[Any, Future]:
        """Send a goal that is accepted; returns its handle and its result to come."""
        handle = self.send(time_limit)
        assert handle.accepted
        return handle, handle.get_result_async()

    def cancel(self, handle: Any) -> None:
        assert len(self.wait(handle.cancel_goal_async()).goals_canceling) == 1

    def call(self, name: str) -> Trigger.Response:
        client = self.peer.create_client(Trigger, f"decision_node/{name}")
        assert self.ros.spin_until(client.service_is_ready)
        return self.wait(client.call_async(Trigger.Request()))

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
    bench = Bench(ros)
    yield bench
    bench.client.destroy()


HOME = (GoalStatus.STATUS_SUCCEEDED, RunMission.Result.HOME)
CANCELED = (GoalStatus.STATUS_CANCELED, RunMission.Result.CANCELED)
RESTARTED = (GoalStatus.STATUS_ABORTED, RunMission.Result.RESTARTED)


def test_a_goal_is_followed_with_feedback_until_the_rover_is_home(ros, bench):
    handle, result = bench.accepted(time_limit=2.0)
    assert ros.spin_until(lambda: handle.status == GoalStatus.STATUS_EXECUTING)
    bench.frame()
    bench.frame(NEAR, sample_count=2)
    assert not result.done()
    while bench.doing() != "RETURN_HOME":
        assert bench.time < 5.0
        bench.frame(NEAR, sample_count=2)
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
    bench.frame(NEAR)
    bench.cancel(handle)
    bench.frame(NEAR)
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
    assert not bench.send().accepted
    bench.cancel(first)
    assert not bench.send().accepted
    bench.frame()
    assert bench.end_of(result) == CANCELED
    assert not bench.send(time_limit=-1.0).accepted
    assert bench.send().accepted


def test_a_goal_starts_a_mission_that_is_over_again(bench):
    results = []
    for _ in range(2):
        _, result = bench.accepted()
        bench.frame(sample_count=3 - len(results))
        bench.call("return_home")
        bench.frame(sample_count=3 - len(results))
        assert bench.end_of(result) == HOME
        results.append(result.result().result.mission)
    assert [mission.samples_total for mission in results] == [3, 2]
    assert results[1].elapsed == pytest.approx(PERIOD)


def test_a_reset_and_a_new_run_abort_the_goal(bench):
    bench.frame()
    _, result = bench.accepted()
    bench.frame(NEAR)
    assert bench.call("reset").success
    assert bench.end_of(result) == RESTARTED
    bench.frame(time=500.0)
    _, result = bench.accepted()
    bench.frame(NEAR)
    bench.frame(time=1.0)
    assert bench.end_of(result) == RESTARTED
    assert result.result().result.mission.state_name == "FORWARD"
    bench.frame()


def test_the_node_ends_while_a_goal_is_active(ros, bench):
    bench.frame()
    handle, result = bench.accepted()
    bench.frame(NEAR)
    ros.nodes.remove(bench.node)
    ros.executor.remove_node(bench.node)
    bench.node.destroy_node()
    assert ros.spin_until(lambda: handle.status == GoalStatus.STATUS_ABORTED)
    assert ros.spin_until(lambda: not bench.client.server_is_ready())
    result.cancel()
