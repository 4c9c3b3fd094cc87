"""Samples: approached, picked up, given up, searched for."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from frames_by_hand import CONFIG, DrivenMission, exploring, frame, heading_home, rock
from maps import MIDDLE, UNKNOWN, straight_plan

from rover_common.geometry import Pose
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.samples import MAX_TRIES
from rover_decision.missions.sample_return.states.pickup import START_SECONDS
from rover_navigation.types import Goal, GoalKind

AHEAD = (rock(103.0, 100.0),)
BESIDE = (rock(MIDDLE.x + 2.0, MIDDLE.y),)


def test_a_rock_is_approached_and_picked_up_only_when_standing():
    mission = exploring(rocks=AHEAD)
    assert mission.tick(rocks=AHEAD).state is State.ROCK_APPROACH
    mission.wait(0.8)
    rolling = mission.tick(rocks=AHEAD, near_sample=True, speed=0.4)
    assert rolling.state is State.PICKUP
    assert not rolling.command.pickup
    assert mission.tick(rocks=AHEAD, near_sample=True).command.pickup
    working = mission.tick(10.0, rocks=AHEAD, near_sample=True, picking_up=True)
    assert not working.command.pickup
    done = mission.tick(rocks=AHEAD, sample_count=2)
    assert done.state is State.FORWARD
    assert done.progress.samples_collected == 1


def test_an_arm_that_does_not_start_is_not_waited_for():
    mission = exploring()
    states = {decision.state for decision in mission.ticks(START_SECONDS, near_sample=True)}
    assert states == {State.PICKUP}
    assert mission.tick_until(State.FORWARD, 1.0).progress.samples_collected == 0


@pytest.mark.parametrize("speed", [1.5, -1.5])
def test_a_sample_is_not_stopped_for_at_speed(speed):
    """It would lie out of reach when the rover stands."""
    assert exploring().tick(near_sample=True, speed=speed).state is State.FORWARD


def test_a_sample_in_reach_on_the_path_home_is_picked_up():
    mission = heading_home()
    pose = Pose(MIDDLE.x + 2.0, MIDDLE.y, 0.0)
    assert mission.tick(pose=pose, near_sample=True).state is State.PICKUP
    mission.tick(pose=pose, picking_up=True)
    assert mission.tick(pose=pose, sample_count=2).state is State.RETURN_HOME


def test_a_rock_out_of_reach_is_given_up_tried_again_and_then_left():
    mission = DrivenMission()
    approaches, before = 0, State.IDLE
    for step in range(1400):
        pose = Pose(100.0 + (step // 2 % 2), 100.0, 0.0)  # moves, so that it is not stuck
        state = mission.tick(0.5, pose=pose, rocks=AHEAD).state
        approaches += state is State.ROCK_APPROACH and before is not state
        before = state
    assert approaches == MAX_TRIES


def test_when_the_time_is_up_it_leaves_a_rock():
    mission = exploring(rocks=AHEAD)
    assert mission.tick(rocks=AHEAD).state is State.ROCK_APPROACH
    mission.mission.limit_time(30.0)  # less than the path home and its reserve take
    assert mission.tick(rocks=AHEAD).state is State.RETURN_HOME


def test_beside_a_rock_it_may_tilt_further():
    """Samples stand on the bases of walls."""
    states = {}
    for share in (1.2, 1.8):  # of the limit
        mission = exploring(rocks=BESIDE)
        assert mission.tick(rocks=BESIDE).state is State.ROCK_APPROACH
        tilted = Pose(MIDDLE.x, MIDDLE.y, 0.0, roll=share * CONFIG.tilt_limit)
        states[share] = mission.tick(pose=tilted, rocks=BESIDE).state
    assert states == {1.2: State.ROCK_APPROACH, 1.8: State.TILT}


def test_a_rock_before_which_it_tilts_again_and_again_is_given_up():
    mission = exploring(rocks=BESIDE)
    tilts, state = 0, State.FORWARD
    while mission.time < 10.0 * CONFIG.rock_deadline:
        roll = 0.3 if state is State.ROCK_APPROACH else 0.0
        decision = mission.tick(pose=Pose(MIDDLE.x, MIDDLE.y, 0.0, roll=roll), rocks=BESIDE)
        tilts += decision.state is State.TILT and state is not State.TILT
        state = decision.state
        if decision.progress.rocks_given_up:
            break
    assert decision.progress.rocks_given_up == 1
    assert tilts > 1
    assert mission.time < 1.0 + 1.5 * CONFIG.rock_deadline


def targets(mission: DrivenMission, **what: object) -> list[int]:
    """The rocks that a plan of the next frame is to lead to."""
    mission.tick(**what)
    request = mission.mission.plan_request(frame(mission.time, **what))(UNKNOWN)
    return [target.id for target in request.targets]


def test_a_rock_where_a_sample_was_picked_up_is_no_target():
    arm = (MIDDLE.x + 0.84, MIDDLE.y)
    rocks = (rock(*arm, number=7), rock(MIDDLE.x + 20.0, MIDDLE.y, number=8))
    mission = exploring()
    assert targets(mission, rocks=rocks) == [7, 8]
    assert targets(mission, rocks=rocks, sample_count=2) == [8]
    assert targets(mission, rocks=rocks, sample_count=0) == []  # all are on board


def test_samples_that_nobody_saw_are_searched_for_only_so_long():
    plan = dataclasses.replace(straight_plan(), goal=Goal(GoalKind.SEARCH, 110.0, 100.0))
    mission = exploring(plan=plan)
    searches = []
    for seconds in np.array([0.1, 0.8, 0.2]) * CONFIG.search_limit:
        mission.wait(seconds)
        mission.tick(plan=plan)
        request = mission.mission.plan_request(frame(mission.time))(UNKNOWN)
        searches.append(request.search)
    assert searches == [True, True, False]
