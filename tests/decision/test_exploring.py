"""Exploring along plans, and what stops it."""

from __future__ import annotations

import dataclasses
import math

import pytest
from frames_by_hand import PLAN, DrivenMission, exploring
from maps import MIDDLE, straight_plan

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.completion import PLANS_WITHOUT_GOAL
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_navigation.blocked_places import STOPS
from rover_navigation.monitors import CIRCLE_SECONDS
from rover_navigation.types import Goal, GoalKind


def test_it_brakes_until_the_first_plan_and_drives_along_it():
    mission = DrivenMission()
    waiting = mission.tick(plan=None)
    assert (waiting.state, waiting.command.brake) == (State.FORWARD, 1.0)
    driving = mission.tick()
    assert driving.command.throttle > 0
    assert driving.command.brake == 0


def test_a_path_behind_is_turned_to_in_place_without_the_brake():
    mission = exploring()
    behind = straight_plan(pose=Pose(MIDDLE.x, MIDDLE.y, math.pi))
    assert mission.tick(speed=1.0, plan=behind).command.brake > 0
    standing = mission.tick(plan=behind)
    assert standing.command.brake == standing.command.throttle == 0
    assert abs(standing.command.steering_angle) == pytest.approx(ROVER.max_steering)


def test_an_obstacle_on_the_path_stops_it_until_another_path_is_free():
    mission = exploring()
    assert mission.tick(ahead=1.0, speed=1.5).state is State.STOP
    aside = straight_plan(pose=Pose(MIDDLE.x, MIDDLE.y, 1.0))
    turning = mission.tick(ahead=1.0, plan=aside)
    assert turning.command.steering_angle == pytest.approx(ROVER.max_steering)
    mission.wait(0.8)
    turned = Pose(MIDDLE.x, MIDDLE.y, 1.0)
    assert mission.tick(pose=turned, plan=aside).state is State.FORWARD


def test_the_faster_it_drives_the_more_clearance_it_needs():
    def state(ahead: float, speed: float) -> State:
        return exploring().tick(ahead=ahead, speed=speed).state

    assert state(1.2, speed=0.4) is State.FORWARD
    assert state(1.2, speed=2.0) is State.STOP
    assert state(3.0, speed=2.0) is State.FORWARD


def test_too_near_to_an_obstacle_for_the_path_it_backs_up_and_goes_on():
    mission = exploring()
    near = mission.ticks(1.9, ahead=0.8)[-1]
    assert near.state is State.STOP
    assert near.command.throttle < 0
    away = mission.tick(pose=Pose(99.6, 100.0, 0.0), ahead=1.2)
    assert away.state is State.FORWARD
    assert away.command.throttle > 0


def test_repeated_stops_on_one_spot_block_the_place_ahead():
    mission = exploring()
    stops = 0
    while stops < STOPS:
        for ahead in (0.8, 1.2):  # it backs up and sets out again
            before = mission.state
            mission.ticks(0.8, ahead=ahead)
            stops += mission.state is State.STOP and before is not State.STOP
        assert len(mission.mission.overlay().blocked) == (stops == STOPS)
    (place,) = mission.mission.overlay().blocked
    assert place.x > MIDDLE.x
    assert math.isfinite(place.until)


def test_an_obstacle_ahead_does_not_keep_it_from_observing_its_goal():
    aside = Goal(GoalKind.FRONTIER, MIDDLE.x, MIDDLE.y + 3.0)
    at_the_end = dataclasses.replace(straight_plan(length=1.0), goal=aside)
    mission = exploring(plan=None)
    for decision in mission.ticks(1.9, ahead=0.9, plan=at_the_end):
        assert decision.state is State.FORWARD
        assert decision.command.steering_angle > 0  # to the left, where the goal is
        assert decision.command.throttle == decision.command.brake == 0


def test_steering_to_one_side_for_long_is_a_circle_which_it_leaves():
    mission = exploring()

    def drive(seconds: float, turn: float) -> State:
        for _ in range(round(10 * seconds)):
            x, yaw = MIDDLE.x + 0.1 * mission.time, 0.05 * mission.time
            left = straight_plan(pose=Pose(x, MIDDLE.y, yaw + turn))
            mission.tick(pose=Pose(x, MIDDLE.y, yaw), speed=1.0, plan=left)
        return mission.state

    assert drive(0.9 * CIRCLE_SECONDS, turn=0.5) is State.FORWARD
    assert drive(0.2 * CIRCLE_SECONDS, turn=0.5) is State.CIRCLE
    assert drive(1.1 * CIRCLE_SECONDS, turn=0.0) is State.FORWARD


def test_when_nothing_is_left_it_goes_home_and_stays():
    mission = exploring()
    for step in range(60):
        mission.tick(0.2, pose=Pose(100.0 + 0.4 * step, 100.0, 0.0))
    far = Pose(123.6, 100.0, 0.0)
    empty = {"plan": straight_plan(pose=far, goal=False), "sample_count": 0}
    for _ in range(PLANS_WITHOUT_GOAL):
        assert mission.state is State.FORWARD
        turned = mission.tick(pose=far, **empty)
    assert turned.state is State.RETURN_HOME
    for step in range(25):  # no jumps
        home = mission.tick(0.5, pose=Pose(123.6 - 0.9 * step, 100.0, math.pi), **empty)
    home = mission.tick(pose=Pose(101.2, 100.0, math.pi), **empty)
    assert home.state is State.DONE
    later = mission.tick(pose=Pose(101.2, 100.0, math.pi), **empty)
    assert (later.command.brake, later.command.throttle) == (1.0, 0.0)


def test_it_maps_on_when_all_samples_are_collected():
    assert exploring().tick(sample_count=0).state is State.FORWARD


def test_when_the_time_is_up_it_goes_home():
    mission = DrivenMission(DecisionConfig(time_limit=60.0))
    for step in range(40):
        if mission.state is State.RETURN_HOME:
            break
        mission.tick(1.0, pose=Pose(100 + step, 100, 0), plan=PLAN)
    assert mission.state is State.RETURN_HOME
    assert 60.0 - mission.time > PLAN.home_seconds  # early enough
