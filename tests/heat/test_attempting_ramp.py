"""ATTEMPTING_RAMP and RETURNING: up, down and back."""

from __future__ import annotations

import numpy as np
from driven_heat import AIR, APPROACH, MIDDLE, RAMP_PITCH, SECOND, STEP, DrivenHeat
from reached_heat import (
    at_ramp,
    exploring,
    interrupted,
    returning,
)

from rover_common.geometry import Pose
from rover_common.sensor_types import ThermalFrame, Twist
from rover_heat.config import HeatConfig
from rover_heat.mission.chart import State
from rover_heat.mission.ramp_attempt import Phase
from rover_heat.planning.types import GoalKind, HeatGoal, HeatPlan
from rover_heat.ramp.climb import Progress
from rover_heat.types import HeatDecision
from rover_navigation.navigator import GoalStatus

ZERO, UP = Twist(), Twist(0.15, 0.0)
FACES = np.array([[3.025, 3.925], [3.075, 3.925], [3.125, 3.925]])


def attempt_of(driven: DrivenHeat):
    return driven.mission._states[State.ATTEMPTING_RAMP]._attempt


def test_it_approaches_turns_climbs_and_releases_the_last_payload():
    driven = at_ramp()
    assert driven.goal.pose == APPROACH.pose
    driven.arrive()
    driven.until(lambda made: made.twist is not None and made.twist.linear > 0.1, 2.0)
    driven.ticks(2.0, pitch=RAMP_PITCH, twist=UP)
    assert driven.state is State.ATTEMPTING_RAMP  # a tilt is what is wanted here
    attempt_of(driven)._climb.progress = Progress.ON_TOP
    launch = driven.until(lambda made: made.launch, 3.0)
    assert launch.twist == ZERO
    after = driven.until_state(State.DONE, 16.0, launches_done=1)
    assert after.progress.ramp_done
    assert after.progress.payloads == 3


def left_alone(driven: DrivenHeat, seconds: float, **what) -> HeatDecision:
    """The sensor that looks to the left says something; returns the last decision."""
    for _ in range(round(seconds / STEP)):
        frame = ThermalFrame(round(driven.time * SECOND), 1, AIR)
        made = driven.tick(thermal=(frame,), **what)
    return made


def test_with_the_sensor_ahead_dead_it_turns_the_other_one_ahead_on_top():
    driven = at_ramp()
    driven.arrive()
    driven.until(lambda made: made.twist is not None and made.twist.linear > 0.1, 2.0)
    attempt_of(driven)._climb.progress = Progress.ON_TOP
    assert left_alone(driven, 4.0).progress.payloads == 3
    turning = left_alone(driven, 0.2, launches_done=1)
    assert (turning.state, turning.twist.linear) == (State.ATTEMPTING_RAMP, 0.0)
    assert turning.twist.angular < -0.1  # its left side comes ahead
    driven.pose = Pose(driven.pose.x, driven.pose.y, driven.pose.yaw - driven.config.thermal_yaw_1)
    assert left_alone(driven, 2.5).state is State.ATTEMPTING_RAMP
    assert left_alone(driven, 1.0).state is State.DONE


def test_on_the_way_to_the_ramp_a_tilt_interrupts():
    driven = interrupted(at_ramp())
    driven.until_state(State.ATTEMPTING_RAMP, 30.0)


def test_three_tries_and_it_is_given_up():
    driven = at_ramp()
    for _ in range(3):
        driven.until_goal(APPROACH.pose)
        driven.goal.status = GoalStatus.FAILED
        driven.tick()
    driven.until_state(State.DONE, 2.0)
    assert not driven.tick().progress.ramp_done
    assert attempt_of(driven).phase is Phase.GIVEN_UP


def test_a_climb_that_fails_backs_down_and_tries_again_faster():
    driven = at_ramp()
    driven.arrive()
    driven.until(lambda made: made.twist is not None and made.twist.linear > 0.1, 2.0)
    driven.move_to(Pose(3.1, 1.0, 0.0), twist=UP)
    attempt_of(driven)._climb.progress = Progress.FAILED
    driven.until(lambda made: made.twist is not None and made.twist.linear < 0.0, 1.5)
    driven.move_to(APPROACH.pose)
    driven.until_goal(APPROACH.pose)
    driven.arrive()
    again = driven.until(lambda made: made.twist is not None and made.twist.linear > 0.1, 2.0)
    assert again.twist.linear == 0.20


def test_an_unknown_ramp_is_sought_and_then_it_is_done_without():
    driven = exploring()
    driven.arrive()
    ground = HeatGoal(GoalKind.GROUND, Pose(1.0, 1.0, 0.0), 1.0, 1.0, 5.0)
    driven.plan = HeatPlan(0)
    driven.until_state(State.ATTEMPTING_RAMP, 8.0)
    assert driven.mission.plan_request(driven.frame())(None).seek_ramp
    driven.plan = HeatPlan(0, goals=(ground,))
    driven.until_goal(ground.pose)
    driven.arrive()
    driven.plan = HeatPlan(0)
    driven.until_state(State.DONE, 6.0)


def test_a_ramp_that_is_met_while_it_is_sought_is_climbed():
    driven = exploring()
    driven.arrive()
    driven.plan = HeatPlan(0)
    driven.until_state(State.ATTEMPTING_RAMP, 8.0)
    interrupted(driven)
    driven.ticks(0.6, pitch=RAMP_PITCH)
    driven.plan = HeatPlan(0, approaches=(APPROACH,))
    driven.until_state(State.ATTEMPTING_RAMP, 30.0)
    driven.until_goal(APPROACH.pose)


def test_it_comes_back_to_the_start():
    driven = returning()
    assert (driven.goal.pose.x, driven.goal.pose.y) == (MIDDLE.x, MIDDLE.y)
    driven.arrive()
    driven.until_state(State.DONE, 1.0)


def test_from_the_ramp_it_backs_down_first():
    driven = at_ramp(HeatConfig(return_to_start=True, payloads=0))
    driven.arrive()
    driven.until(lambda made: made.twist is not None and made.twist.linear > 0.1, 2.0)
    driven.move_to(Pose(3.6, 1.0, 0.0), twist=UP)
    attempt_of(driven)._climb.progress = Progress.ON_TOP
    driven.until_state(State.RETURNING, 1.0)
    down = driven.until(lambda made: made.twist != ZERO, 1.0, pitch=RAMP_PITCH)
    assert (down.state, down.twist.linear < 0.0) == (State.RETURNING, True)
    driven.move_to(APPROACH.pose)
    driven.until_goal(MIDDLE, 2.0)
