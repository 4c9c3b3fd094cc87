"""The navigator node: the action as Nav2 serves it, map, transforms, plan, hazards."""

from __future__ import annotations

import math

import numpy as np
import pytest
from action_msgs.msg import GoalStatus
from geometry_msgs.msg import TransformStamped
from maze_world import box
from navigator_bench import NavigatorBench
from node_endpoints import endpoints, listed
from rclpy.executors import SingleThreadedExecutor
from readme_tables import ROOT, table

from rover_common import frames
from rover_common.geometry import Pose, distance_between, wrap_angle
from rover_common.input_monitor import InputLimits
from rover_common.ros.conversions import grid_message_of, grid_of, stamp_of
from rover_common.ros.runner import EventsExecutor
from rover_common.ros.transforms import pose_of_transform
from rover_common.sensor_types import Twist
from rover_common.types import GridMap
from rover_navigation.node import NavigatorNode
from rover_navigation.node_config import NavigatorNodeConfig

README = ROOT / "rover_navigation" / "README.md"
HALL = np.array(box(0.0, 0.0, 3.0, 2.0))
START = Pose(0.5, 0.5, 0.2)


@pytest.fixture(params=[SingleThreadedExecutor, EventsExecutor], ids=["single", "events"])
def bench(ros, request):
    """With the executor of the tests, and with the one that the node runs on."""
    ros.executor.shutdown()
    ros.executor = request.param(context=ros.context)
    bench = NavigatorBench(ros, HALL, START)
    bench.wait(1.5)
    yield bench
    bench.client.destroy()


def test_a_goal_is_reached_with_feedback_at_every_tick(bench):
    handle = bench.send_goal(Pose(1.6, 1.2, 2.0))
    before = len(bench.ticks)
    answer = bench.drive(handle.get_result_async(), 30.0)
    assert answer.status == GoalStatus.STATUS_SUCCEEDED
    assert (answer.result.error_code, answer.result.error_msg) == (0, "")
    assert distance_between(bench.world.pose, Pose(1.6, 1.2, 0.0)) < 0.07
    assert abs(wrap_angle(bench.world.pose.yaw - 2.0)) < 0.15
    driven = [tick for tick in bench.ticks[before:] if tick.velocity]
    bench.spin_until(lambda: len(bench.feedback) >= len(driven))
    assert len(bench.feedback) == len(driven)  # and the result at the one after
    stamps = [stamp_of(each.current_pose.header.stamp) for each in bench.feedback]
    assert np.diff(stamps).tolist() == [50_000_000] * (len(stamps) - 1)
    left = [each.distance_remaining for each in bench.feedback]
    assert max(left) == pytest.approx(1.3, abs=0.3)
    assert left[-1] < 0.1
    spent = [each.estimated_time_remaining.sec for each in bench.feedback]
    assert spent[0] >= spent[-1]
    assert bench.tick() == Twist()


@pytest.mark.parametrize(
    ("goal", "reason"),
    [
        (Pose(math.nan, 0.0, 0.0), "the goal is not a number"),
        (Pose(50.0, 0.0, 0.0), "the goal is out of the map"),
        (Pose(0.02, 0.5, 0.0), "the goal is in a wall"),
    ],
)
def test_a_goal_that_cannot_be_driven_to_is_aborted_with_the_reason(bench, goal, reason):
    handle = bench.send_goal(goal)
    assert handle.accepted
    answer = bench.result_of(handle.get_result_async())
    assert answer.status == GoalStatus.STATUS_ABORTED
    assert answer.result.error_msg == reason
    assert answer.result.error_code != 0
    assert not bench.ticks[-1].velocity


def test_a_goal_in_another_frame_is_rejected(bench):
    assert not bench.send_goal(Pose(1.0, 1.0, 0.0), "odom").accepted
    assert bench.send_goal(Pose(1.0, 1.0, 0.0), "").accepted


def test_a_newer_goal_takes_the_place_of_the_old_one_which_is_aborted(bench):
    first = bench.send_goal(Pose(2.4, 0.5, 0.0))
    result = first.get_result_async()
    bench.wait(1.0)
    second = bench.send_goal(Pose(0.6, 1.4, 0.0))
    answer = bench.result_of(result)
    assert (answer.status, answer.result.error_code) == (GoalStatus.STATUS_ABORTED, 0)
    answer = bench.drive(second.get_result_async(), 30.0)
    assert answer.status == GoalStatus.STATUS_SUCCEEDED
    assert distance_between(bench.world.pose, Pose(0.6, 1.4, 0.0)) < 0.07


def test_a_canceled_goal_ends_without_a_further_tick_and_the_robot_is_let_go(bench):
    handle = bench.send_goal(Pose(2.4, 0.5, 0.0))
    result = handle.get_result_async()
    bench.wait(1.0)
    assert bench.ticks[-1].velocity
    assert len(bench.result_of(handle.cancel_goal_async()).goals_canceling) == 1
    assert bench.result_of(result).status == GoalStatus.STATUS_CANCELED
    bench.tick()
    assert not bench.ticks[-1].velocity


def test_map_transform_and_plan(bench):
    assert len(bench.maps) == 1
    message = bench.maps[0]
    grid = grid_of(message)
    assert (message.header.frame_id, grid.resolution) == (frames.MAP, 0.05)
    assert (grid.cells.min(), grid.cells.max() > 65) == (-1, True)
    at_maps = [stamp_of(tick.header.stamp) for tick in bench.ticks if tick.map]
    assert at_maps == [stamp_of(message.header.stamp)]

    def newest() -> TransformStamped:
        return bench.transforms[-1].transforms[-1]

    bench.spin_until(lambda: stamp_of(newest().header.stamp) == bench.world.stamp)
    link = newest()
    assert (link.header.frame_id, link.child_frame_id) == (frames.MAP, frames.ODOM)
    assert distance_between(pose_of_transform(link), Pose(0.0, 0.0, 0.0)) < 0.02
    bench.send_goal(Pose(2.4, 1.5, 0.0))
    bench.wait(1.0)
    end = bench.plans[-1].poses[-1].pose.position
    goal = bench.world.in_map(Pose(2.4, 1.5, 0.0))
    assert math.dist((end.x, end.y), (goal.x, goal.y)) < 0.1
    assert len(bench.maps) == 2


def test_paths_keep_off_the_places_of_the_hazard_map(bench):
    grid = grid_of(bench.maps[-1])
    bench.hazards.publish(grid_message_of(7, grid))
    bench.spin_until(lambda: stamp_of(bench.ticks[-1].hazards) == 7)
    there = bench.world.in_map(Pose(1.5, 0.5, 0.0))
    cells = grid.cells.copy()
    row = int((there.y - grid.origin_y) / grid.resolution)
    col = int((there.x - grid.origin_x) / grid.resolution)
    cells[row - 4 : row + 5, col - 4 : col + 5] = 100
    blocked = GridMap(grid.resolution, grid.origin_x, grid.origin_y, cells)
    bench.hazards.publish(grid_message_of(8, blocked))
    bench.spin_until(lambda: stamp_of(bench.ticks[-1].hazards) == 8)
    answer = bench.result_of(bench.send_goal(Pose(1.5, 0.5, 0.0)).get_result_async())
    assert answer.result.error_msg == "the goal is in a wall"
    bench.send_goal(Pose(2.5, 0.5, 0.0))
    bench.wait(0.5)
    points = [(p.pose.position.x, p.pose.position.y) for p in bench.plans[-1].poses]
    assert min(math.dist(point, (there.x, there.y)) for point in points) > 0.2


def test_the_readme_lists_its_topics(ros):
    node = ros.add(NavigatorNode, stamped_cmd_vel="true", lockstep=True)
    assert listed(README, "Publishes") == endpoints(node.publishers)
    assert listed(README, "Subscribes") == endpoints(node.subscriptions)


def test_the_readme_lists_its_parameters():
    rows = table(README, "Parameters of `navigator_node`")
    fields = [
        *NavigatorNodeConfig.__dataclass_fields__.values(),
        *InputLimits.__dataclass_fields__.values(),
    ]
    assert [row["parameter"] for row in rows] == [field.name for field in fields]
    for row, field in zip(rows, fields, strict=True):
        info = field.metadata["parameter"]
        assert (row["default"], row["meaning"]) == (str(field.default), info.description)
