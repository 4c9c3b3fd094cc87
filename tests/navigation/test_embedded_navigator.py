"""The embedded navigator in a maze: goals reached, goals refused, inputs that fail."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest
from maze_world import MazeWorld, box, cell_center, maze

from rover_common.burger import BURGER
from rover_common.geometry import Pose, compose, distance_between, wrap_angle
from rover_common.sensor_types import Twist
from rover_common.types import GridMap
from rover_navigation.burger_scale import BURGER_SCALE
from rover_navigation.embedded_goal import EmbeddedGoal
from rover_navigation.embedded_navigator import EmbeddedNavigator, NavigatorOutput
from rover_navigation.navigator import GoalStatus
from rover_navigation.navigator_config import NavigatorConfig

AT_START = Pose(0.0, 0.0, 0.0)
HALL = np.array(box(0.0, 0.0, 3.0, 2.0))


class Drive:
    """A navigator that drives a world."""

    def __init__(self, walls: np.ndarray, start: Pose, odometry_at: Pose = AT_START) -> None:
        self.world = MazeWorld(walls, start, seed=1, odometry_at=odometry_at)
        self.navigator = EmbeddedNavigator(BURGER, BURGER_SCALE, NavigatorConfig(samples=400), 1)
        self.twist = Twist()

    def steps(self, seconds: float) -> Iterator[NavigatorOutput]:
        """One output a step."""
        for _ in range(round(seconds * 20)):
            output = self.navigator.step(self.world.step(self.twist))
            self.twist = output.twist or Twist()
            yield output

    def wait(self, seconds: float) -> NavigatorOutput:
        return list(self.steps(seconds))[-1]

    def go(self, pose: Pose, seconds: float, tolerance: float = 0.08) -> EmbeddedGoal:
        """Drive to a pose of the world until the goal is final."""
        goal = self.navigator.go_to(self.world.in_map(pose), tolerance)
        for _ in self.steps(seconds):
            if goal.status.final:
                break
        return goal

    def error(self, output: NavigatorOutput) -> float:
        """[m] of the pose."""
        assert output.pose is not None
        return distance_between(output.pose, self.world.in_map(self.world.pose))


@pytest.fixture
def hall() -> Drive:
    drive = Drive(HALL, Pose(0.5, 0.5, 0.2))
    drive.wait(1.5)
    return drive


def test_a_goal_is_reached_within_its_tolerance_and_heading(hall):
    goal = hall.go(Pose(2.4, 1.5, -2.0), 40.0)
    assert goal.status is GoalStatus.REACHED
    assert distance_between(hall.world.pose, Pose(2.4, 1.5, 0.0)) < 0.10
    assert abs(wrap_angle(hall.world.pose.yaw + 2.0)) < 0.15
    assert hall.world.contacts == 0


def test_it_stands_still_until_it_has_a_map():
    drive = Drive(HALL, Pose(0.5, 0.5, 0.2))
    outputs = list(drive.steps(0.9))
    assert not drive.navigator.is_ready
    assert outputs[-1].why == "standing still for the first map"
    assert drive.navigator.go_to(Pose(0.5, 0.0, 0.0), 0.1).status is GoalStatus.FAILED
    drive.wait(0.5)
    assert drive.navigator.is_ready


@pytest.mark.parametrize(
    ("goal", "reason"),
    [
        (Pose(math.nan, 0.0, 0.0), "the goal is not a number"),
        (Pose(50.0, 0.0, 0.0), "the goal is out of the map"),
        (Pose(-0.75, -0.7, 0.0), "the goal is in unknown cells"),
        (Pose(-0.5, 0.2, 0.0), "the goal is in a wall"),
        (Pose(-0.42, 0.2, 0.0), "the goal is too near to a wall"),
    ],
)
def test_a_goal_that_cannot_be_driven_to_is_refused(goal, reason):
    drive = Drive(HALL, Pose(0.5, 0.5, 0.0))
    drive.wait(1.5)
    refused = drive.navigator.go_to(goal, 0.05)
    assert refused.status is GoalStatus.FAILED
    assert refused.reason == reason
    assert drive.wait(0.1).twist is None


def test_a_new_goal_replaces_the_old_one(hall):
    first = hall.navigator.go_to(hall.world.in_map(Pose(2.4, 0.5, 0.0)), 0.1)
    hall.wait(1.0)
    second = hall.go(Pose(0.6, 1.4, 0.0), 30.0)
    assert first.status is GoalStatus.CANCELLED
    assert second.status is GoalStatus.REACHED


def test_without_a_goal_another_controller_may_drive(hall):
    assert hall.wait(0.1).twist is None
    goal = hall.navigator.go_to(hall.world.in_map(Pose(2.4, 0.5, 0.0)), 0.1)
    assert hall.wait(1.0).twist != Twist()
    goal.cancel()
    assert hall.wait(0.05).twist is None


@pytest.mark.parametrize(("switch", "name"), [("scans_on", "scan"), ("odometry_on", "odometry")])
def test_it_stops_in_a_gap_of_its_input_and_goes_on(hall, switch, name):
    goal = hall.navigator.go_to(hall.world.in_map(Pose(2.4, 0.5, 0.0)), 0.1)
    hall.wait(2.0)
    setattr(hall.world, switch, False)
    output = hall.wait(1.0)
    assert output.twist == Twist()
    assert output.why == f"no {name} for 0.5 s"
    setattr(hall.world, switch, True)
    for _ in hall.steps(30.0):
        if goal.status.final:
            break
    assert goal.status is GoalStatus.REACHED


def test_it_stops_where_its_pose_jumps_and_goes_on(hall):
    goal = hall.navigator.go_to(hall.world.in_map(Pose(2.4, 0.5, 0.0)), 0.1)
    hall.wait(2.0)
    hall.world.shift_odometry(Pose(7.0, 7.0, 2.0))
    outputs = list(hall.steps(0.3))
    stopped = [output for output in outputs if output.why == "found the pose again"]
    assert [output.twist for output in stopped] == [Twist()]
    assert outputs[-1].relocations == 1
    for _ in hall.steps(30.0):
        if goal.status.final:
            break
    assert goal.status is GoalStatus.REACHED


def test_it_keeps_off_blocked_places_that_the_mission_names(hall):
    output = next(output for output in hall.steps(2.0) if output.map is not None)
    assert output.map is not None
    grid = output.map
    y, x = np.indices(grid.cells.shape) * grid.resolution
    x, y = x + grid.origin_x, y + grid.origin_y
    cells = np.where((np.abs(x - 0.8) < 0.15) & (y < 0.45), np.int8(100), grid.cells)
    hall.navigator.set_hazards(GridMap(grid.resolution, grid.origin_x, grid.origin_y, cells))
    goal = hall.navigator.go_to(Pose(1.6, 0.2, 0.0), 0.1)
    for output in hall.steps(40.0):
        assert output.pose is not None
        assert not (abs(output.pose.x - 0.8) < 0.2 and output.pose.y < 0.5)
        if goal.status.final:
            break
    assert goal.status is GoalStatus.REACHED


def test_the_poses_of_the_last_seconds_can_be_asked_for(hall):
    hall.navigator.go_to(hall.world.in_map(Pose(2.4, 0.5, 0.0)), 0.1)
    true = {}
    for output in hall.steps(3.0):
        true[output.stamp] = hall.world.in_map(hall.world.pose)
    for stamp, pose in true.items():
        asked = hall.navigator.pose_at(stamp)
        assert asked is not None
        assert distance_between(asked, pose) < 0.03
    assert hall.navigator.pose_at(max(true) + 1_000_000_000) is None


def test_a_map_is_given_out_once_a_second(hall):
    stamps = [output.stamp for output in hall.steps(4.0) if output.map is not None]
    assert len(stamps) == 4
    assert set(np.diff(stamps)) == {1_000_000_000}


def test_the_transform_from_map_to_odom_carries_the_odometry_onto_the_pose(hall):
    hall.navigator.go_to(hall.world.in_map(Pose(2.4, 1.5, 0.0)), 0.1)
    for output in hall.steps(4.0):
        assert output.map_to_odom is not None
        assert output.pose is not None
        carried = compose(output.map_to_odom, hall.world.odometry)
        assert (carried.x, carried.y) == pytest.approx((output.pose.x, output.pose.y), abs=1e-6)
    assert np.linalg.eigvalsh(output.covariance).min() > 0.0


def test_the_same_seed_drives_the_same_way_bit_for_bit():
    def poses() -> list[Pose]:
        drive = Drive(HALL, Pose(0.5, 0.5, 0.2))
        drive.wait(1.5)
        drive.navigator.go_to(drive.world.in_map(Pose(2.0, 1.5, 1.0)), 0.1)
        return [drive.world.pose for _ in drive.steps(5.0)]

    assert poses() == poses()


def test_it_tours_a_maze_without_touching_a_wall():
    drive = Drive(maze(3), Pose(*cell_center(0, 0), 0.1), odometry_at=Pose(1e9, -1e9, 2.0))
    drive.wait(1.5)
    errors = []
    reached = 0
    for cell in ((0, 1), (1, 0), (1, 1), (2, 1), (2, 2), (1, 2), (0, 0)):
        goal = drive.navigator.go_to(drive.world.in_map(Pose(*cell_center(*cell), 0.0)), 0.1)
        for output in drive.steps(40.0):
            errors.append(drive.error(output))
            if goal.status.final:
                break
        reached += goal.status is GoalStatus.REACHED
    assert reached >= 3
    assert drive.world.contacts == 0
    assert np.sqrt(np.mean(np.square(errors))) < 0.03
    assert max(errors) < 0.08
