"""TILT_INTERRUPT: stop, mark, back off."""

from __future__ import annotations

import numpy as np
import pytest
from driven_heat import MIDDLE, RAMP_PITCH
from reached_heat import (
    exploring,
    interrupted,
)

from rover_common.geometry import Pose
from rover_common.sensor_types import Twist
from rover_heat.mission.chart import State
from rover_navigation.navigator import GoalStatus

ZERO, UP = Twist(), Twist(0.15, 0.0)
FACES = np.array([[3.025, 3.925], [3.075, 3.925], [3.125, 3.925]])


def test_it_stops_marks_the_ramp_and_backs_to_level_ground():
    driven = exploring()
    driven.move_to(Pose(2.8, 2.0, 0.0))
    first = driven.until_state(State.TILT_INTERRUPT, 1.0, pitch=RAMP_PITCH)
    assert first.twist == ZERO
    assert driven.goal.status is GoalStatus.CANCELLED
    marked = driven.ticks(0.6, pitch=RAMP_PITCH)[-1]
    assert len(marked.hazards.strips) == len(marked.hazards.discs) == 1
    backing = driven.until(lambda made: made.twist != ZERO, 1.0, pitch=RAMP_PITCH)
    assert backing.twist.linear < 0.0
    driven.move_to(Pose(2.4, 2.0, 0.0))
    assert driven.until_state(State.EXPLORING, 1.0).hazards == marked.hazards


def test_a_jolt_marks_nothing_and_costs_half_a_second():
    driven = interrupted(exploring())
    driven.until_state(State.EXPLORING, 0.8)
    hazards = driven.tick().hazards
    assert (hazards.strips, hazards.discs) == ((), ())
    assert any("jolt" in notice for notice in driven.notices)


def test_it_does_not_back_into_what_the_lidar_sees():
    driven = exploring()
    driven.mission.parts.track.update(Pose(0.0, 2.0, 0.0), level=True)
    driven.move_to(Pose(0.19, 2.0, 0.0))
    interrupted(driven)
    decisions = driven.ticks(1.0, pitch=RAMP_PITCH)
    assert all(decision.twist.linear >= 0.0 for decision in decisions)


def test_a_pose_that_is_not_reached_in_8_s_is_given_up_for_an_older_one():
    driven = exploring()
    driven.move_to(Pose(2.9, 2.0, 0.0))
    interrupted(driven)
    driven.ticks(7.5, pitch=RAMP_PITCH)
    assert driven.state is State.TILT_INTERRUPT
    driven.until(lambda made: made.state is State.EXPLORING, 18.0)


def test_a_robot_that_leans_on_a_wall_marks_no_ramp():
    driven = exploring()
    driven.move_to(Pose(3.85, 2.0, 0.0))
    interrupted(driven)
    hazards = driven.ticks(0.6, pitch=RAMP_PITCH)[-1].hazards
    assert (hazards.strips, hazards.discs) == ((), ())


def test_wheels_that_slip_block_what_is_ahead():
    driven = exploring()
    driven.until_state(State.TILT_INTERRUPT, 2.0, twist=Twist(0.2, 0.0))
    (disc,) = driven.tick().hazards.discs
    assert (disc.x, disc.y) == pytest.approx((MIDDLE.x + 0.2, MIDDLE.y))
