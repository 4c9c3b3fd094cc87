"""GOAL_NAVIGATION and LAUNCHING: to a source, and its payload."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from driven_heat import SECOND, SOURCE, STAND
from reached_heat import (
    explored_plan,
    exploring,
    launching,
    navigating,
    paused,
)

from rover_common.geometry import Pose
from rover_common.sensor_types import ThermalFrame, Twist
from rover_decision.types import Request
from rover_heat.config import HeatConfig
from rover_heat.mission.chart import State
from rover_navigation.navigator import GoalStatus

ZERO, UP = Twist(), Twist(0.15, 0.0)
FACES = np.array([[3.025, 3.925], [3.075, 3.925], [3.125, 3.925]])


def test_it_drives_to_the_stand_off_and_launches_there():
    driven = navigating()
    assert driven.goal.tolerance <= 0.08
    driven.arrive()
    driven.until_state(State.LAUNCHING, 0.5)


def test_arrived_too_far_aside_it_drives_again():
    driven = navigating()
    driven.move_to(Pose(2.1, 3.7, math.pi / 2))
    before = len(driven.navigator.goals)
    driven.goal.status = GoalStatus.REACHED
    driven.ticks(0.5)
    assert driven.state is State.GOAL_NAVIGATION
    assert len(driven.navigator.goals) == before + 1


def test_three_poses_in_vain_leave_the_source_to_the_end():
    driven = navigating()
    for _ in range(6):
        driven.goal.status = GoalStatus.FAILED
        driven.ticks(0.3)
    assert driven.until_state(State.ATTEMPTING_RAMP, 1.0).progress.sources_delivered == 0


def test_late_is_another_pose():
    driven = navigating()
    driven.goal.recovering = True
    before = len(driven.navigator.goals)
    driven.ticks(3 * STAND.seconds + 9.0)
    assert len(driven.navigator.goals) == before
    driven.ticks(2.0)
    assert len(driven.navigator.goals) == before + 1
    assert any("later than planned" in notice for notice in driven.notices)


def test_it_signals_once_and_waits_for_the_report():
    driven = launching()
    driven.until(lambda made: made.launch, 3.0)
    decisions = driven.ticks(10.0)
    assert {decision.twist for decision in decisions} == {ZERO}
    assert driven.launches == 1
    after = driven.tick(launches_done=1)
    assert after.state is State.ATTEMPTING_RAMP
    assert (after.progress.sources_delivered, after.progress.payloads) == (1, 3)


def test_it_turns_to_the_warm_column_first():
    driven = launching()
    column = np.full((8, 8), 24.0, np.float32)
    column[2:5, 2] += 8.0  # 11 degrees to the left
    for _ in range(20):
        stamp = round(driven.time * SECOND)
        decision = driven.tick(thermal=(ThermalFrame(stamp, 2, column),))
        assert not decision.launch
    assert decision.twist.angular > 0.0
    assert decision.twist.linear == 0.0


def test_after_5_s_of_turning_it_takes_the_sources_place():
    driven = launching()
    column = np.full((8, 8), 24.0, np.float32)
    column[2:5, 2] += 8.0
    while driven.launches == 0:
        stamp = round(driven.time * SECOND)
        driven.tick(thermal=(ThermalFrame(stamp, 2, column),))
    assert driven.time < 10.0 + 60.0


@pytest.mark.parametrize(
    "moving", [{"twist": Twist(0.05, 0.0)}, {"turn": 0.1}], ids=["drives", "turns"]
)
def test_a_robot_that_does_not_stand_does_not_launch(moving):
    driven = launching()
    driven.until_state(State.GOAL_NAVIGATION, 14.0, **moving)
    assert driven.launches == 0


def test_a_source_that_proves_cold_is_not_served():
    driven = navigating()
    driven.plan = explored_plan(sources=(replace(SOURCE, observations=20),))
    driven.ticks(1.2)
    driven.arrive()
    driven.until_state(State.ATTEMPTING_RAMP, 4.0, turn=0.04)  # too restless to launch
    assert driven.launches == 0
    assert any("cold" in notice for notice in driven.notices)


def test_a_silent_launcher_counts_as_launched_with_a_warning():
    driven = launching()
    driven.until(lambda made: made.launch, 3.0)
    driven.ticks(14.5)
    assert driven.state is State.LAUNCHING
    assert driven.until_state(State.ATTEMPTING_RAMP, 1.0).progress.sources_delivered == 1
    assert any("did not report" in notice for notice in driven.notices)


def test_a_second_report_is_ignored():
    driven = launching()
    driven.tick(launches_done=1)  # of nobody's sequence
    assert driven.state is State.LAUNCHING
    driven.until(lambda made: made.launch, 3.0)
    driven.tick(launches_done=1)
    after = driven.tick(launches_done=1)
    assert (after.progress.sources_delivered, after.progress.payloads) == (1, 3)


def test_a_pause_amid_a_sequence_does_not_launch_again():
    driven = launching()
    driven.until(lambda made: made.launch, 3.0)
    paused(driven)
    driven.ticks(3.0)
    driven.mission.request(Request.RESUME)
    driven.ticks(3.0)
    driven.tick(launches_done=1)
    assert driven.launches == 1
    assert driven.state is State.ATTEMPTING_RAMP


def test_one_payload_is_kept_for_the_ramp():
    driven = navigating(HeatConfig(payloads=2))
    driven.arrive()
    driven.until(lambda made: made.launch, 4.0)
    driven.plan = explored_plan()
    assert driven.tick(launches_done=1).state is State.ATTEMPTING_RAMP
    none = exploring(HeatConfig(payloads=1))
    none.arrive()
    none.plan = explored_plan()
    assert none.until(lambda made: made.state is not State.EXPLORING, 8.0).state is (
        State.ATTEMPTING_RAMP
    )
