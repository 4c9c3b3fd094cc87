"""heat_node in front of a server of navigate_to_pose that refuses, fails, dies and comes back."""

from __future__ import annotations

import math

import pytest
from heat_bench import ROOM, HeatBench
from mapped_rooms import map_of
from stand_in_nav2 import place_of

from rover_common.ros.sensor_conversions import twist_of
from rover_common.sensor_types import Twist
from rover_common.types import GridMap

AWAY = 20.0  # [s] that a navigator may be away


def room_without(*parts: tuple[slice, slice]) -> GridMap:
    """The room's map, in which parts of it (rows, columns) [cells] are not known yet."""
    grid = map_of(ROOM, [(1.5, 1.5), (3.0, 3.0)])
    cells = grid.cells.copy()
    for part in parts:
        cells[part] = -1
    return GridMap(grid.resolution, grid.origin_x, grid.origin_y, cells)


FAR, NEAR = slice(70, None), slice(0, 60)  # beyond 3.0 m, up to 2.5 m
EAST, NORTH = room_without((NEAR, FAR)), room_without((FAR, NEAR))  # where a frontier lies
WEST = (NEAR, slice(0, 18))  # short of 0.4 m
THREE = room_without((NEAR, FAR), (FAR, NEAR), WEST)


@pytest.fixture
def bench(ros) -> HeatBench:
    """It explores by lidar: each frontier is one goal."""
    return HeatBench(ros, fast_explore=True)


def explore(bench: HeatBench, grid: GridMap) -> None:
    """Up to the first goal, accepted or not."""
    bench.robot.send_map(grid)
    bench.until(lambda: bench.server.goals or bench.server.rejected, 8.0)
    assert bench.state == "EXPLORING"


def is_east(goal: tuple[float, float]) -> bool:
    return goal[0] > goal[1]


def test_a_goal_is_given_once_and_driven_to(bench):
    explore(bench, EAST)
    assert is_east(bench.server.newest)
    bench.seconds(5.0)
    assert len(bench.server.goals) == 1
    bench.server.succeed()
    bench.robot.send_map(NORTH)
    bench.until(lambda: len(bench.server.goals) == 2, 3.0)
    assert not is_east(bench.server.newest)


@pytest.mark.parametrize("how", ["rejected", "aborted"])
def test_a_goal_that_fails_is_left_alone_for_a_minute_and_another_is_chosen(bench, how):
    bench.server.rejects = how == "rejected"
    explore(bench, THREE)
    if how == "rejected":
        bench.server.rejects = False
    else:
        bench.server.abort(208, "no valid path")
    first = place_of((bench.server.rejected or bench.server.goals)[0])
    before = len(bench.server.goals)
    for count in (1, 2):  # all others come first
        bench.until(lambda count=count: len(bench.server.goals) == before + count, 5.0)
        assert math.dist(bench.server.newest, first) > 0.5
        assert bench.state == "EXPLORING"
        bench.seconds(1.5)
        bench.server.succeed()


def test_a_goal_that_our_own_newer_one_replaces_is_not_left_alone(bench):
    explore(bench, EAST)
    first = bench.server.newest
    bench.robot.send_map(NORTH)  # nothing is to be seen in the east any more
    bench.until(lambda: len(bench.server.goals) == 2, 5.0)
    assert not is_east(bench.server.newest)
    bench.robot.send_map(EAST)
    bench.until(lambda: len(bench.server.goals) == 3, 5.0)
    assert math.dist(bench.server.newest, first) < 0.1
    assert bench.server.canceled == 0  # each took the place of the one before


def test_a_navigator_that_dies_and_is_back_in_time_gets_the_same_goal_again(bench):
    explore(bench, EAST)
    goal = bench.server.newest
    bench.server.die()
    bench.until(lambda: bench.state == "HOLD", 0.5)
    assert "navigator" in bench.reason
    bench.seconds(AWAY - 5.0)
    assert twist_of(bench.velocities[-1].twist) == Twist()
    assert bench.state == "HOLD"
    bench.server.come_back()
    bench.wait(lambda: bench.node._navigator.is_present)
    bench.until(lambda: len(bench.server.goals) == 2, 3.0)
    assert bench.state == "EXPLORING"
    assert math.dist(bench.server.newest, goal) < 1e-9


@pytest.mark.parametrize("how", ["dies", "stalls"])
def test_a_navigator_that_is_gone_for_good_is_a_failure(bench, how):
    explore(bench, EAST)
    if how == "dies":
        bench.server.die()
    else:
        bench.ros.executor.remove_node(bench.server)  # it does not answer
        bench.speaks = False
    bench.until(lambda: bench.state == "HOLD", 0.5)
    bench.seconds(AWAY - 1.0)
    assert bench.state == "HOLD"
    bench.until(lambda: bench.state == "FAILED", 2.0)
    assert "navigator" in bench.reason
