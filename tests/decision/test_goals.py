"""What the mission remembers of its goals, and of the ways home that it tried."""

import dataclasses
import math

import numpy as np
from rover import MIDDLE, straight_plan

from rover_common.geometry import Pose
from rover_decision.home import WayHome
from rover_navigation.goal_history import FORGET, LINGER, GoalMemory
from rover_navigation.types import Goal, GoalKind


def test_what_was_looked_at_in_vain_is_left_alone_and_the_more_of_it_the_farther_off():
    def settled(distance: float) -> np.ndarray:
        goals = GoalMemory()
        way = straight_plan(length=1.0)
        goal = Goal(GoalKind.FRONTIER, MIDDLE.x + distance, MIDDLE.y)
        for time in np.arange(0.0, LINGER + 0.5, 0.1):
            goals.update(float(time), MIDDLE, dataclasses.replace(way, goal=goal))
        return goals.visited(5.0)

    near, far = settled(2.0), settled(8.0)
    assert near[:, :2].tolist() == [[MIDDLE.x + 2.0, MIDDLE.y]]
    assert far[0, 2] > 1.5 * near[0, 2] > 1.0


def test_only_what_is_in_view_has_been_looked_at():
    goals = GoalMemory()
    way = straight_plan(length=1.0)
    aside = Goal(GoalKind.FRONTIER, MIDDLE.x, MIDDLE.y + 2.0)
    times = np.arange(0.0, 2 * LINGER, 0.1)
    for time in times:
        goals.update(float(time), MIDDLE, dataclasses.replace(way, goal=aside))
    assert len(goals.visited(float(times[-1]))) == 0
    facing = Pose(MIDDLE.x, MIDDLE.y, math.pi / 2)
    for time in times + 2 * LINGER:
        goals.update(float(time), facing, dataclasses.replace(way, goal=aside))
    settled = 4 * LINGER
    assert len(goals.visited(settled)) == 1
    assert len(goals.doubtful(settled)) == 0
    later = settled + FORGET
    assert len(goals.visited(later)) == 0
    assert len(goals.doubtful(later)) == 1


def test_what_was_looked_at_from_afar_is_settled_only_the_second_time():
    goals = GoalMemory()
    way = straight_plan(length=1.0)
    goal = Goal(GoalKind.FRONTIER, MIDDLE.x + 8.0, MIDDLE.y)
    elsewhere = Goal(GoalKind.FRONTIER, MIDDLE.x, MIDDLE.y + 30.0)

    def look(stamp: int, start: float) -> None:
        for later, seen in ((0, goal), (1, elsewhere)):
            plan = dataclasses.replace(way, goal=seen, stamp=2 * stamp + later)
            for time in np.arange(0.0, LINGER + 0.3, 0.1):
                goals.update(start + later * 3.0 + float(time), MIDDLE, plan)

    look(1, 0.0)
    assert len(goals.visited(LINGER + 1.0)) == 1
    assert len(goals.visited(30.0)) == len(goals.doubtful(30.0)) == 0
    look(2, 30.0)
    assert len(goals.visited(60.0)) == 1
    assert len(goals.visited(30.0 + 2 * FORGET)) == 0
    assert len(goals.doubtful(30.0 + 2 * FORGET)) == 1


def test_before_the_end_what_was_seen_from_afar_is_open_again_and_from_near_doubtful():
    goals = GoalMemory()
    way = straight_plan(length=1.0)
    for stamp, distance in ((1, 2.0), (2, 8.0)):
        goal = Goal(GoalKind.FRONTIER, MIDDLE.x + distance, MIDDLE.y)
        seen = dataclasses.replace(way, goal=goal, stamp=stamp)
        for time in np.arange(0.0, LINGER + 0.5, 0.1):
            goals.update(5.0 * stamp + float(time), MIDDLE, seen)
    assert len(goals.visited(12.0)) == 2
    assert goals.doubt_visited(12.0)
    assert len(goals.visited(12.0)) == 0
    assert goals.doubtful(12.0)[:, 0].tolist() == [MIDDLE.x + 2.0]
    assert not goals.doubt_visited(13.0)  # nothing that could be doubted more


def test_a_way_home_on_which_the_rover_gets_stuck_again_is_left_for_the_next():
    home = WayHome("shortest_path")
    home.begin(0.0)
    home.trouble()
    assert home.method == "shortest_path"
    home.begin(10.0)
    home.trouble()
    assert home.method != "shortest_path"
