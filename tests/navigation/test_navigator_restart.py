"""A navigator that is started again goes on with its map and its pose, if the robot is the same."""

from __future__ import annotations

import copy
import json
from dataclasses import replace

import numpy as np
import pytest
from maze_world import MazeWorld
from navigator_bench import NavigatorBench
from test_localizer import ROOM, START

from rover_common.burger import BURGER
from rover_common.geometry import Pose, compose, distance_between, quaternion_from_pose
from rover_common.ros.conversions import grid_of, map_begun_of
from rover_common.same_robot import OLDEST
from rover_common.saved_state import Memory
from rover_common.sensor_types import SensorBatch, Twist
from rover_navigation.burger_scale import BURGER_SCALE
from rover_navigation.embedded_navigator import EmbeddedNavigator, NavigatorOutput
from rover_navigation.navigator import GoalStatus
from rover_navigation.navigator_config import NavigatorConfig
from rover_navigation.node import NavigatorNode

TOUR = (Twist(), Twist(0.2, 0.0), Twist(0.05, 1.2), Twist(0.2, 0.1))


def make(**what: float) -> EmbeddedNavigator:
    return EmbeddedNavigator(BURGER, BURGER_SCALE, NavigatorConfig(samples=200, **what), 1)


def batches(world: MazeWorld, seconds: float, *twists: Twist) -> list[SensorBatch]:
    """Each twist for so long; the inertial unit is not mounted quite level."""
    steps = [world.step(twist) for twist in twists for _ in range(round(seconds * 20))]
    turned = quaternion_from_pose(Pose(0.0, 0.0, 0.0, pitch=0.1))
    return [
        replace(step, imus=tuple(replace(imu, orientation=turned) for imu in step.imus))
        for step in steps
    ]


def world_at(odometry_at: Pose = START) -> MazeWorld:
    return MazeWorld(ROOM, START, seed=3, odometry_at=odometry_at)


def steps(navigator: EmbeddedNavigator, given: list[SensorBatch]) -> list[NavigatorOutput]:
    return [navigator.step(batch) for batch in given]


def kept(memory: Memory) -> Memory:
    """As it comes from a file."""
    return json.loads(json.dumps(memory[0])), memory[1]


def restored(navigator: EmbeddedNavigator) -> EmbeddedNavigator:
    other = make()
    other.restore(kept(navigator.memory()()))
    return other


def told(output: NavigatorOutput) -> tuple:
    """But for when maps are due, and that no scan has come yet."""
    pose = output.pose, output.map_to_odom, output.covariance.tolist()
    return output.stamp, pose, output.relocations, output.twist


def test_pose_and_map_go_on_bit_by_bit():
    world, navigator = world_at(), make()
    steps(navigator, batches(world, 2.0, *TOUR, *TOUR)[:-1])  # no scan waits for its odometry
    made, rest = navigator.memory(), batches(world, 2.0, *TOUR)
    expected = steps(navigator, rest)  # it goes on while the copy is made into a memory
    other = make()
    other.restore(kept(made()))
    assert [told(o) for o in steps(other, rest)] == [told(o) for o in expected]
    one, two = (each._localizer.map.cells.grid() for each in (navigator, other))
    assert np.array_equal(one.cells, two.cells)
    assert (one.origin_x, one.origin_y) == (two.origin_x, two.origin_y)
    assert other.map_begun == navigator.map_begun > 0


def test_it_does_not_stand_for_a_first_map_and_gives_its_map_out_at_once():
    world, navigator = world_at(), make()
    steps(navigator, batches(world, 2.0, *TOUR))
    other = restored(navigator)
    output = other.step(world.step(Twist()))
    assert other.is_ready
    assert output.map is not None
    assert np.count_nonzero(output.map.cells >= 0) > 1000
    assert other.go_to(world.in_map(START), 0.1).status is not GoalStatus.FAILED


def test_what_the_robot_drove_meanwhile_is_no_jump():
    world, navigator = world_at(), make()
    steps(navigator, batches(world, 2.0, *TOUR))
    other = restored(navigator)
    before = world.pose
    batches(world, 2.0, Twist(-0.2, 0.0))  # while nobody listens
    assert distance_between(before, world.pose) > 0.3
    outputs = steps(other, batches(world, 1.0, Twist()))
    assert outputs[-1].relocations == 0
    assert distance_between(outputs[-1].pose, world.in_map(world.pose)) < 0.03
    world.shift_odometry(Pose(50.0, 0.0, 0.0))
    assert steps(other, batches(world, 1.0, Twist()))[-1].relocations == 1  # but the next one is


def test_a_robot_that_was_carried_meanwhile_is_searched():
    world, navigator = world_at(), make()
    steps(navigator, batches(world, 2.0, *TOUR))
    other = restored(navigator)
    world.kidnap(compose(world.pose, Pose(-0.25, 0.2, 0.4)))
    outputs = steps(other, batches(world, 3.0, Twist()))
    assert outputs[-1].relocations == 1
    assert distance_between(outputs[-1].pose, world.in_map(world.pose)) < 0.05


@pytest.mark.parametrize("spoil", ["values", "arrays", "number", "cells", "resolution", "no map"])
def test_a_memory_that_is_none_changes_nothing(spoil):
    world, navigator, fresh = world_at(), make(), make()
    if spoil == "resolution":
        fresh = make(resolution=0.1)
    if spoil != "no map":
        steps(navigator, batches(world, 2.0, *TOUR))
    values, arrays = copy.deepcopy(navigator.memory()())
    if spoil == "values":
        del values["tilt"]
    elif spoil == "arrays":
        arrays = {}
    elif spoil == "number":
        values["pose"]["relocations"] = "many"
    elif spoil == "cells":
        arrays["map.cells.cells"] = arrays["map.cells.cells"] + 10**6
    before = fresh._localizer
    with pytest.raises((ValueError, TypeError, KeyError)):
        fresh.restore((values, arrays))
    assert fresh._localizer is before
    assert not fresh.has_map


class TestNode:
    """One node after another, before the same robot or another one."""

    @pytest.fixture
    def bench(self, ros):
        bench = NavigatorBench(ros, ROOM, START)
        bench.wait(1.5)
        bench.send_goal(Pose(0.8, 1.6, 0.0))
        bench.wait(4.0)
        yield bench
        bench.client.destroy()

    def again(self, bench: NavigatorBench, **parameters) -> None:
        ros = bench.ros
        ros.end(bench.node)
        bench.ticks.clear()
        bench.node = ros.add(NavigatorNode, lockstep=True, samples=200, **parameters)
        for publisher in (bench._scan, bench._imu, bench._odometry, bench._tick):
            bench.spin_until(lambda p=publisher: p.get_subscription_count() > 0)
        bench.spin_until(lambda: bench.node._velocity.connected and bench.client.server_is_ready())

    def pose_is_right(self, bench: NavigatorBench) -> bool:
        pose = bench.node._navigator.pose_at(bench.world.stamp)
        return distance_between(pose, bench.world.in_map(bench.world.pose)) < 0.03

    def test_the_next_one_goes_on_in_the_same_map(self, bench):
        assert distance_between(bench.world.pose, START) > 0.3
        before = grid_of(bench.maps[-1])
        begun = map_begun_of(bench.maps[-1])
        self.again(bench)
        count = len(bench.maps)
        bench.tick()
        bench.spin_until(lambda: len(bench.maps) > count)
        assert self.pose_is_right(bench)
        after = grid_of(bench.maps[-1])
        assert np.count_nonzero(after.cells >= 0) >= np.count_nonzero(before.cells >= 0)
        assert map_begun_of(bench.maps[-1]) == begun > 0
        result = bench.send_goal(START).get_result_async()
        assert bench.drive(result, 30.0).result.error_msg == ""
        assert distance_between(bench.world.pose, START) < 0.1

    @pytest.mark.parametrize("other", ["odometry begun anew", "too late", "earlier", "no folder"])
    def test_before_another_robot_it_begins_anew(self, bench, other):
        begun = map_begun_of(bench.maps[-1])
        if other == "odometry begun anew":
            bench.world.shift_odometry(Pose(9.0, 9.0, 0.0))
        elif other == "too late":
            bench.world._ticks += round((OLDEST + 1.0) * 100)
        elif other == "earlier":
            bench.world._ticks = 10
        self.again(bench, state_dir="" if other == "no folder" else "auto")
        bench.tick()
        assert not bench.node._navigator.has_map
        bench.wait(1.5)
        assert bench.node._navigator.map_begun not in (0, begun)
        assert not self.pose_is_right(bench)

    def test_a_state_is_kept_only_once_there_is_a_map(self, ros, tmp_path):
        bench = NavigatorBench(ros, ROOM, START, state_dir=str(tmp_path))
        bench.wait(0.5)
        ros.end(bench.node)
        bench.client.destroy()
        assert list(tmp_path.iterdir()) == []
