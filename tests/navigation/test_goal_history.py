"""Goals that were observed without result: for how long they are left, and how far around."""

import dataclasses
import math

import numpy as np
from maps import MIDDLE, SCALE, straight_plan

from rover_common.geometry import Pose
from rover_navigation.goal_history import (
    BLACKLIST_SECONDS,
    OBSERVE_SECONDS,
    OUT_OF_REACH,
    GoalHistory,
)
from rover_navigation.types import NO_PATH, Goal, GoalKind, Plan

AT_THE_END = straight_plan(length=1.0)  # of a path of half a metre


def observe(goals: GoalHistory, goal: Goal, start: float, stamp: int = 0, pose: Pose = MIDDLE):
    """Stand at the end of the path to a goal for a little longer than an observation takes."""
    seen = dataclasses.replace(AT_THE_END, goal=goal, stamp=stamp)
    for time in np.arange(0.0, OBSERVE_SECONDS + 0.5, 0.1):
        goals.update(start + float(time), pose, seen)


def ahead(distance: float) -> Goal:
    return Goal(GoalKind.FRONTIER, MIDDLE.x + distance, MIDDLE.y)


def test_an_observation_settles_a_disc_that_is_wider_the_farther_off():
    def settled(distance: float) -> np.ndarray:
        goals = GoalHistory(SCALE)
        observe(goals, ahead(distance), 0.0)
        return goals.blacklisted(5.0)

    near, far = settled(2.0), settled(8.0)
    assert near[:, :2].tolist() == [[MIDDLE.x + 2.0, MIDDLE.y]]
    assert far[0, 2] > 1.5 * near[0, 2] > 1.0


def test_only_a_goal_in_view_is_observed():
    goals = GoalHistory(SCALE)
    aside = Goal(GoalKind.FRONTIER, MIDDLE.x, MIDDLE.y + 2.0)
    observe(goals, aside, 0.0)
    observe(goals, aside, 2.0)
    assert len(goals.blacklisted(4.0)) == 0
    observe(goals, aside, 4.0, pose=Pose(MIDDLE.x, MIDDLE.y, math.pi / 2))
    assert len(goals.blacklisted(6.0)) == 1


def test_a_goal_observed_from_near_is_blacklisted_and_retryable_afterwards():
    goals = GoalHistory(SCALE)
    observe(goals, ahead(2.0), 0.0)
    assert (len(goals.blacklisted(2.0)), len(goals.retryable(2.0))) == (1, 0)
    later = 2.0 + BLACKLIST_SECONDS
    assert (len(goals.blacklisted(later)), len(goals.retryable(later))) == (0, 1)


def test_a_goal_observed_from_afar_is_settled_only_the_second_time():
    goals = GoalHistory(SCALE)
    goal, elsewhere = ahead(8.0), Goal(GoalKind.FRONTIER, MIDDLE.x, MIDDLE.y + 30.0)
    for stamp, start in ((1, 0.0), (3, 30.0)):
        observe(goals, goal, start, stamp)
        observe(goals, elsewhere, start + 3.0, stamp + 1)
        if start == 0.0:
            assert len(goals.blacklisted(2.0)) == 1
            assert len(goals.blacklisted(30.0)) == len(goals.retryable(30.0)) == 0
    assert len(goals.blacklisted(60.0)) == 1
    long_after = 30.0 + 2 * BLACKLIST_SECONDS
    assert len(goals.blacklisted(long_after)) == 0
    assert len(goals.retryable(long_after)) == 1


def test_a_goal_that_is_not_reached_is_blacklisted():
    goals = GoalHistory(SCALE)
    plan = straight_plan()
    for time in np.arange(0.0, OUT_OF_REACH + 1.0, 0.5):
        assert len(goals.blacklisted(float(time))) == 0
        goals.update(float(time), MIDDLE, plan)
    assert goals.blacklisted(OUT_OF_REACH + 1.0)[0, :2].tolist() == [plan.goal.x, plan.goal.y]


def test_retry_reopens_goals_seen_from_afar_and_makes_the_others_retryable():
    goals = GoalHistory(SCALE)
    for stamp, distance in ((1, 2.0), (2, 8.0)):
        observe(goals, ahead(distance), 5.0 * stamp, stamp)
    assert len(goals.blacklisted(12.0)) == 2
    assert goals.retry(12.0)
    assert len(goals.blacklisted(12.0)) == 0
    assert goals.retryable(12.0)[:, 0].tolist() == [MIDDLE.x + 2.0]
    assert not goals.retry(13.0)  # nothing is left to reopen


def test_forget_reopens_every_goal():
    goals = GoalHistory(SCALE)
    observe(goals, ahead(2.0), 0.0)
    assert goals.forget()
    assert len(goals.blacklisted(2.0)) == len(goals.retryable(999.0)) == 0
    assert not goals.forget()


def test_plans_without_a_goal_are_counted_once_each_and_in_a_row():
    goals = GoalHistory(SCALE)
    without = [straight_plan(stamp=stamp, goal=False) for stamp in (1, 2, 3)]
    for plan in (without[0], without[0], without[1]):
        goals.update(1.0, MIDDLE, plan)
    assert (goals.missing, goals.unplaced) == (2, 0)
    goals.update(1.1, MIDDLE, straight_plan(stamp=9))
    assert goals.missing == 0
    goals.update(1.2, MIDDLE, without[2])
    goals.await_plans()
    assert goals.missing == 0


def test_plans_that_do_not_place_the_robot_are_counted_apart():
    def unplaced(plan: Plan) -> int:
        goals = GoalHistory(SCALE)
        goals.update(1.0, MIDDLE, plan)
        assert goals.missing == 0
        return goals.unplaced

    no_goal = straight_plan(stamp=1, goal=False)
    assert unplaced(dataclasses.replace(no_goal, placed=False)) == 1
    enclosed = dataclasses.replace(no_goal, home_path=NO_PATH, home_seconds=math.inf)
    assert unplaced(enclosed) == 1
    assert unplaced(straight_plan(stamp=1)) == 0
