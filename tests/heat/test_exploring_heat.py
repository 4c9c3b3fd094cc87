"""INITIALIZING and EXPLORING: what is waited for, which goals are driven to, and when it ends."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from driven_heat import GOAL, SECOND, DrivenHeat, goal_plan
from reached_heat import (
    explored_plan,
    exploring,
    navigating,
)

from rover_common.geometry import Pose
from rover_common.sensor_types import ThermalFrame, Twist
from rover_heat.config import HeatConfig
from rover_heat.mission.chart import State
from rover_heat.planning.types import GoalKind, HeatGoal, HeatPlan
from rover_navigation.navigator import GoalStatus

ZERO, UP = Twist(), Twist(0.15, 0.0)
FACES = np.array([[3.025, 3.925], [3.075, 3.925], [3.125, 3.925]])


def test_it_stands_for_two_seconds_before_it_begins():
    driven = DrivenHeat()
    decisions = driven.ticks(1.9)
    assert {decision.state for decision in decisions} == {State.INITIALIZING}
    assert {decision.twist for decision in decisions} == {ZERO}
    driven.until_state(State.EXPLORING, 0.5)
    assert any("0 degrees" in notice for notice in driven.notices)


def test_a_robot_that_is_pushed_is_measured_anew():
    driven = DrivenHeat()
    driven.ticks(1.5)
    driven.tick(turn=0.2, twist=Twist(0.0, 0.2))
    assert {decision.state for decision in driven.ticks(1.9)} == {State.INITIALIZING}


@pytest.mark.parametrize(
    ("missing", "name"),
    [({"grid": None}, "map"), ({"pose": None}, "pose"), ({"imus": ()}, "level")],
)
def test_it_says_what_is_missing_and_fails_after_a_minute(missing, name):
    driven = DrivenHeat()
    driven.ticks(59.0, **missing)
    assert driven.state is State.INITIALIZING
    said = [notice for notice in driven.notices if name in notice]
    assert 10 <= len(said) <= 13
    decision = driven.until_state(State.FAILED, 2.0, **missing)
    assert name in decision.reason
    assert decision.twist == ZERO


def test_without_a_navigator_it_fails():
    driven = DrivenHeat()
    driven.navigator.is_ready = False
    assert "navigator" in driven.until_state(State.FAILED, 61.0).reason


@pytest.mark.parametrize("sensors", [(1,), (2,), ()])
def test_without_thermal_sensors_it_goes_on_after_20_s_with_a_warning(sensors):
    driven = DrivenHeat()
    frames = tuple(ThermalFrame(0, n, np.full((8, 8), 24.0, np.float32)) for n in sensors)
    while driven.state is State.INITIALIZING:
        stamp = round(driven.time * SECOND)
        driven.tick(thermal=tuple(replace(frame, stamp=stamp) for frame in frames))
    assert 20.0 <= driven.time - 10.0 < 21.0
    assert any(notice.startswith("warning") for notice in driven.notices)


def test_it_drives_to_the_first_goal_of_the_plan():
    driven = exploring()
    assert driven.goal.pose == GOAL.pose
    decision = driven.tick()
    assert (decision.twist, decision.reason) == (None, "drives to a frontier")


def test_a_reached_frontier_is_not_driven_to_again():
    driven = exploring()
    driven.plans = False
    driven.arrive()
    driven.ticks(1.0)
    assert len(driven.navigator.goals) == 1
    assert driven.mission.overlay().visited.tolist() == [[GOAL.x, GOAL.y]]


def test_a_frontier_that_is_there_still_after_the_visit_is_known():
    driven = exploring()
    driven.plans = False
    driven.arrive()
    request = driven.mission.plan_request(driven.frame())(None)
    assert request.known.tolist() == [[GOAL.x, GOAL.y, 0.2]]


def test_a_goal_seen_on_the_way_is_given_up_for_the_next_without_blame():
    driven = exploring()
    other = replace(GOAL, pose=Pose(1.0, 2.0, 0.0), x=0.6)
    driven.plan = goal_plan(other)
    driven.until_goal(other.pose)
    request = driven.mission.plan_request(driven.frame())(None)
    assert len(request.failed) == 0
    assert driven.navigator.goals[0].status is GoalStatus.CANCELLED


def test_a_goal_is_kept_while_another_is_not_much_better():
    driven = exploring()
    near = replace(GOAL, pose=Pose(2.3, 2.0, 0.0), x=2.6, seconds=3.0)
    driven.plan = goal_plan(near, GOAL)
    driven.ticks(3.0)
    assert driven.goal.pose == GOAL.pose
    driven.plan = replace(driven.plan, goals=(replace(near, seconds=0.5), GOAL))
    driven.until_goal(near.pose)


def test_a_failed_goal_is_not_chosen_again_and_another_one_is():
    driven = exploring()
    other = replace(GOAL, pose=Pose(1.0, 2.0, 0.0), x=0.6)
    driven.plan = goal_plan(GOAL, other)
    driven.ticks(1.2)
    driven.goal.status, driven.goal.reason = GoalStatus.FAILED, "no path"
    driven.until_goal(other.pose, 1.5)
    assert "goal given up: no path" in driven.notices
    request = driven.mission.plan_request(driven.frame())(None)
    assert request.failed[:, :2].tolist() == [[GOAL.x, GOAL.y]]


def test_at_a_view_it_looks_for_some_frames():
    view = HeatGoal(GoalKind.VIEW, Pose(3.0, 3.5, 1.57), 3.05, 3.9, 5.0, FACES)
    driven = DrivenHeat()
    driven.plan = HeatPlan(0, goals=(view,), open_faces=FACES, goal_seconds=5.0)
    driven.until_state(State.EXPLORING, 5.0)
    driven.until(lambda _: bool(driven.navigator.goals), 2.0)
    driven.move_to(view.pose, thermal=())
    driven.goal.status = GoalStatus.REACHED
    begun = driven.time
    driven.plan = HeatPlan(0, open_faces=FACES, goal_seconds=0.1)
    driven.until(lambda made: "waits" in made.reason, 2.0, thermal=())
    assert 0.7 <= driven.time - begun <= 1.5


def test_a_view_ends_when_its_faces_are_examined():
    view = HeatGoal(GoalKind.VIEW, Pose(3.0, 3.5, 1.57), 3.05, 3.9, 5.0, FACES)
    driven = DrivenHeat()
    driven.plan = HeatPlan(0, goals=(view,), open_faces=FACES, goal_seconds=5.0)
    driven.until_state(State.EXPLORING, 5.0)
    driven.until(lambda _: bool(driven.navigator.goals), 2.0)
    driven.plans = False
    driven.arrive()
    driven.until(lambda made: "waits" in made.reason, 0.4)


def test_a_view_that_shows_nothing_twice_is_given_up():
    view = HeatGoal(GoalKind.VIEW, Pose(2.5, 2.0, 0.0), 3.05, 3.9, 5.0, FACES)
    driven = DrivenHeat()
    driven.plan = HeatPlan(0, goals=(view,), open_faces=FACES, goal_seconds=5.0)
    driven.until_state(State.EXPLORING, 5.0)
    for count in (1, 2):
        driven.until(lambda _, n=count: len(driven.navigator.goals) == n, 4.0)
        assert given_up(driven) == 0
        driven.arrive()
    driven.ticks(3.0)
    assert given_up(driven) == len(FACES)


def given_up(driven: DrivenHeat) -> int:
    """Cells that count as seen from everywhere."""
    sectors = driven.mission.parts.sensing.coverage.snapshot().sectors
    return int(np.count_nonzero(sectors == 2**32 - 1))


def test_when_nothing_is_left_it_delivers_what_is_known():
    driven = exploring()
    driven.arrive()
    driven.plan = explored_plan()
    driven.until_state(State.GOAL_NAVIGATION, 6.0)


def test_the_explored_share_stays_where_no_wall_is_in_reach():
    driven = exploring()
    driven.plan = replace(explored_plan(), explored=0.75, goals=(GOAL,))
    driven.ticks(3.0)
    driven.plan = replace(explored_plan(), explored=math.nan, goals=(GOAL,))
    decisions = driven.ticks(3.0)
    assert {decision.progress.explored for decision in decisions} == {0.75}


def test_what_has_failed_is_tried_once_more_before_it_is_over():
    driven = exploring()
    driven.goal.status = GoalStatus.FAILED
    driven.plan = HeatPlan(0, waiting=(GOAL,))
    driven.ticks(2.2)
    request = driven.mission.plan_request(driven.frame())(None)
    assert len(request.failed) == 0  # forgiven
    driven.ticks(3.0)
    assert driven.state is not State.EXPLORING  # and only once


def test_at_60_percent_of_the_time_it_delivers_and_at_85_it_climbs():
    driven = exploring(HeatConfig(time_limit=100.0))
    driven.plan = replace(explored_plan(), goals=(GOAL,))
    driven.ticks(20.0)
    assert driven.state is State.EXPLORING
    driven.time = 10.0 + 59.0
    driven.mission.parts.inputs._seen.update(scan=69.0, imu=69.0)
    driven.until_state(State.GOAL_NAVIGATION, 3.0)
    assert 0.6 <= (driven.time - 10.0) / 100.0 < 0.62


def test_without_a_source_the_time_alone_does_not_end_it_before_85_percent():
    driven = exploring(HeatConfig(time_limit=20.0))
    driven.until(lambda made: made.state is not State.EXPLORING, 20.0)
    assert (driven.time - 10.0) / 20.0 == pytest.approx(0.85, abs=0.01)
    assert driven.state is State.ATTEMPTING_RAMP


def test_at_the_end_of_the_time_it_is_done_with_what_it_has():
    driven = navigating(HeatConfig(time_limit=30.0))
    driven.goal.recovering = True
    driven.until_state(State.DONE, 30.0)
    assert driven.time - 10.0 == pytest.approx(30.0, abs=0.11)


@pytest.mark.parametrize("deliver", ["at_once", "at_end"])
def test_a_sure_source_is_served_at_once_when_asked(deliver):
    driven = exploring(HeatConfig(deliver=deliver))
    driven.plan = replace(explored_plan(), goals=(GOAL,), frontiers=np.array([[GOAL.x, GOAL.y]]))
    driven.ticks(3.0)
    expected = State.GOAL_NAVIGATION if deliver == "at_once" else State.EXPLORING
    assert driven.state is expected
