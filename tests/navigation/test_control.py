"""The controller, its phases and the recoveries, on maps drawn by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from test_path_planner import GOAL, HERE, ground, hall

from rover_common.burger import BURGER
from rover_common.geometry import Pose, compose, distance_between, wrap_angle
from rover_common.sensor_types import Twist
from rover_common.types import GridMap
from rover_navigation.burger_scale import BURGER_SCALE
from rover_navigation.control.critics import Scene, Trajectories, cost_of
from rover_navigation.control.goal_driver import GoalDriver, Phase, nearest_index
from rover_navigation.control.goal_run import GoalRun
from rover_navigation.control.mppi import PERIOD, Mppi
from rover_navigation.control.recoveries import ORDER, PATIENCE, SECONDS, Recoveries, Recovery
from rover_navigation.embedded_goal import EmbeddedGoal
from rover_navigation.navigator import GoalStatus
from rover_navigation.navigator_config import NavigatorConfig


def driver(seed: int = 1) -> GoalDriver:
    return GoalDriver(
        BURGER, BURGER_SCALE.inflation, Mppi(BURGER, 300, np.random.default_rng(seed))
    )


def drive(
    grid: GridMap, start: Pose, goal: Pose, seconds: float = 40.0, seed: int = 1
) -> tuple[GoalDriver, list[Pose], list[Twist]]:
    """With wheels that do at once what they are told."""
    driving, pose, twist = driver(seed), start, Twist()
    place = ground(grid)
    poses, twists = [pose], [twist]
    for index in range(round(seconds / PERIOD)):
        if index % 10 == 0:
            path = place.path(pose, goal, 0.05)
        twist = driving.twist(pose, twist, place.costmap, path, goal, (0.05, 0.08))
        pose = compose(pose, Pose(twist.linear * PERIOD, 0.0, twist.angular * PERIOD))
        poses.append(pose)
        twists.append(twist)
        if driving.phase is Phase.REACHED:
            break
    return driving, poses, twists


@pytest.mark.parametrize("yaw", [0.0, 3.0])
def test_it_drives_through_a_gap_of_0_45_m_and_ends_at_the_goals_heading(yaw):
    end = Pose(GOAL.x, GOAL.y, -1.5)
    driving, poses, twists = drive(hall(0.45), Pose(HERE.x, HERE.y, yaw), end)
    assert driving.phase is Phase.REACHED
    assert distance_between(poses[-1], end) < 0.05
    assert abs(wrap_angle(poses[-1].yaw - end.yaw)) < 0.1
    gap_ends = ((1.525, 0.8), (1.525, 1.25))
    least = min(math.dist((p.x, p.y), end) for p in poses for end in gap_ends)
    assert least > BURGER.body_radius
    assert all(abs(t.linear) <= BURGER.cruise_speed + 1e-6 for t in twists)
    assert all(abs(t.angular) <= BURGER.cruise_turn + 1e-6 for t in twists)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_it_drives_up_to_a_goal_near_a_wall(seed):
    end = Pose(2.775, 1.025, math.pi / 2)
    driving, poses, _ = drive(hall(), Pose(0.5, 1.025, 0.0), end, seed=seed)
    assert driving.phase is Phase.REACHED
    assert distance_between(poses[-1], end) < 0.05
    assert max(pose.x for pose in poses) < 2.95 - BURGER.body_radius


def test_it_turns_in_place_to_a_path_that_begins_behind_it():
    _, poses, twists = drive(hall(), Pose(HERE.x, HERE.y, math.pi), GOAL, 1.0)
    assert all(twist.linear == 0.0 for twist in twists[:10])
    assert distance_between(poses[10], HERE) < 0.01


def test_it_drives_forwards():
    _, _, twists = drive(hall(), HERE, GOAL)
    assert min(twist.linear for twist in twists) > -0.03
    cruising = [twist.linear for twist in twists[20:-60]]
    assert np.mean(cruising) > 0.8 * BURGER.cruise_speed


def cost(x: float, y: float, yaw: float = 0.0, linear: float = 0.1, angular: float = 0.0) -> float:
    """Of standing at a place of a hall whose path leads along its middle from x = 1."""
    shape = (40, 1)
    paths = Trajectories(*(np.full(shape, value, np.float32) for value in (x, y, yaw)))
    path = np.stack([np.linspace(1.0, 1.55, 12), np.full(12, 1.0)], axis=1).astype(np.float32)
    scene = Scene(ground(hall()).costmap, path, BURGER.body_radius, BURGER_SCALE.inflation)
    velocities = (np.full(shape, value, np.float32) for value in (linear, angular))
    return float(cost_of(paths, *velocities, scene)[0])


def test_the_critics_want_the_robot_on_the_path_ahead_clear_of_walls_and_forwards():
    assert cost(1.2, 0.12) > cost(1.2, 0.24) + 100.0  # a collision
    assert cost(1.2, 1.2) > cost(1.2, 1.0)
    assert cost(1.1, 1.0) > cost(1.2, 1.0)
    assert cost(1.2, 1.0, yaw=1.0) > cost(1.2, 1.0)
    assert cost(1.2, 1.0, linear=-0.05) > cost(1.2, 1.0)
    assert cost(1.2, 1.0, angular=1.0) > cost(1.2, 1.0)
    beside = [cost(1.2, y) - 8.0 * abs(y - 1.0) for y in (0.24, 0.28)]
    assert beside[0] > beside[1]


def test_a_robot_too_near_to_a_wall_gets_away_from_it():
    grid, start = hall(), Pose(0.14, 1.0, 1.5)
    driving, poses, _ = drive(grid, start, GOAL)
    assert driving.phase is Phase.REACHED
    assert min(pose.x for pose in poses) > 0.12


def test_the_same_seed_gives_the_same_velocities_bit_for_bit():
    first, second = (drive(hall(0.45), HERE, GOAL, 4.0)[2] for _ in range(2))
    assert first == second


def test_the_nearest_point_is_sought_at_the_beginning_of_the_path():
    out = np.stack([np.arange(0.0, 2.0, 0.05), np.zeros(40)], axis=1)
    back = np.stack([np.arange(2.0, 0.0, -0.05), np.full(40, 0.1)], axis=1)
    there = nearest_index(np.concatenate([out, back]), Pose(0.3, 0.09, 0.0))
    assert there == 6


def test_recoveries_follow_each_other_and_end_within_ten_seconds():
    assert sum(SECONDS.values()) + (len(ORDER) - 1) * PATIENCE <= 10.0
    recoveries, seen, time = Recoveries(), [], 0.0
    while not recoveries.exhausted(HERE):
        recoveries.begin(time, HERE, -1)
        assert recoveries.active is not None
        seen.append(recoveries.active)
        twists = []
        while (twist := recoveries.twist(time, True)) is not None:
            twists.append(twist)
            time += PERIOD
        assert {
            Recovery.WAIT: all(t == Twist() for t in twists),
            Recovery.TURN: all(t.linear == 0.0 and t.angular < 0.0 for t in twists),
            Recovery.BACK: sum(t.linear for t in twists) * PERIOD == pytest.approx(-0.1, abs=0.02),
        }[seen[-1]]
    assert tuple(seen) == ORDER


def test_it_does_not_back_into_what_is_behind():
    recoveries = Recoveries()
    for _ in ORDER:
        recoveries.begin(0.0, HERE, 1)
    assert recoveries.active is Recovery.BACK
    assert recoveries.twist(0.1, may_back=False) == Twist()


def test_trouble_elsewhere_begins_with_the_first_recovery_again():
    recoveries = Recoveries()
    for _ in ORDER:
        recoveries.begin(0.0, HERE, 1)
    assert recoveries.exhausted(HERE)
    assert not recoveries.exhausted(GOAL)
    recoveries.begin(9.0, GOAL, 1)
    assert recoveries.active is Recovery.WAIT


class StuckRobot:
    """Does not move whatever it is told; or the way is closed."""

    def __init__(self, grid: GridMap) -> None:
        self.grid = grid
        self.run = GoalRun(
            BURGER, BURGER_SCALE, NavigatorConfig(samples=100), np.random.default_rng(1)
        )
        self.goal = EmbeddedGoal(GOAL, 0.1)
        self.run.begin(self.goal)
        self.time = 0.0
        self.reasons: list[str] = []

    def step(self) -> Twist:
        self.time += PERIOD
        twist = self.run.step(
            round(self.time * 1e9), HERE, lambda body: ground(self.grid, body=body), 1
        )
        if not self.reasons or self.reasons[-1] != self.run.why:
            self.reasons.append(self.run.why)
        return twist

    def until_final(self) -> None:
        while not self.goal.status.final and self.time < 30.0:
            self.step()


def test_a_robot_that_makes_no_progress_tries_all_recoveries_and_fails():
    stuck = StuckRobot(hall())
    stuck.until_final()
    assert stuck.goal.status is GoalStatus.FAILED
    assert stuck.goal.reason == "no progress"
    assert stuck.goal.recoveries == len(ORDER)
    assert [r for r in stuck.reasons if ":" in r] == [f"no progress: {r.value}" for r in ORDER]
    assert stuck.time < 2 * PATIENCE + 10.0


def test_a_way_that_closes_fails_the_goal_and_one_that_opens_again_does_not():
    closed = StuckRobot(hall(0.05))
    closed.until_final()
    assert closed.goal.reason == "no path to the goal"
    assert closed.time < 10.0
    opens = StuckRobot(hall(0.05))
    for _ in range(30):
        opens.step()
    assert opens.goal.recovering
    opens.grid = hall(0.45)
    for _ in range(20):
        opens.step()
    assert opens.goal.status is GoalStatus.DRIVING
    assert not opens.goal.recovering
    assert opens.goal.distance_left == pytest.approx(2.0, abs=0.1)


def test_a_robot_that_was_held_goes_on_without_a_recovery():
    held = StuckRobot(hall())
    for _ in range(round(0.9 * PATIENCE / PERIOD)):
        held.step()
    held.run.hold()
    for _ in range(round(0.9 * PATIENCE / PERIOD)):
        held.step()
    assert held.goal.recoveries == 0
