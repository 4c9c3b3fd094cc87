"""STUCK and TILT: how the mission gets into trouble on the ground, and out of it."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from frames_by_hand import (
    CONFIG,
    PLAN,
    TILTED,
    DrivenMission,
    exploring,
    heading_home,
)
from maps import MIDDLE, straight_plan

from rover_common.geometry import Pose
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.completion import PLANS_WITHOUT_GOAL
from rover_decision.missions.sample_return.states.stop import STOP_SECONDS
from rover_decision.types import Request
from rover_navigation.monitors import ON_ONE_SPOT, STALL_SECONDS
from rover_navigation.recovery import RECOVERY_STEPS
from rover_navigation.types import NO_PATH


def test_a_rover_that_is_held_is_stuck_soon_and_one_that_waits_is_not():
    mission = DrivenMission()
    waiting = {decision.state for decision in mission.ticks(2.5, plan=None)}
    assert waiting == {State.FORWARD}  # for the first plan, with the brake on
    begun = mission.time
    mission.tick_until(State.STUCK, 10.0)
    assert mission.time - begun == pytest.approx(STALL_SECONDS, abs=0.3)


def test_no_progress_leads_to_every_recovery_step_and_in_the_end_home():
    mission = DrivenMission()
    decisions, blocked = [], False
    for _ in range(1500):
        decisions.append(mission.tick())
        blocked |= len(mission.mission.overlay().blocked) > 0
    stuck = [decision for decision in decisions if decision.state is State.STUCK]
    assert stuck[0].command.throttle < 0
    assert blocked
    assert decisions[-1].progress.recoveries > len(RECOVERY_STEPS)
    states = [decision.state for decision in decisions]
    assert State.RETURN_HOME in states or states[-1] is State.DONE


def test_a_tilt_stops_backs_off_and_blocks_the_place_for_good():
    mission = DrivenMission()
    for step in range(10):
        mission.tick(pose=Pose(99.0 + 0.1 * step, 100, 0))
    assert mission.tick(pose=TILTED, speed=1.0).command.brake == 1.0
    assert mission.state is State.TILT
    assert mission.tick(pose=TILTED).command.throttle < 0
    (place,) = mission.mission.overlay().blocked
    assert place.until == math.inf
    assert mission.tick(pose=Pose(99.2, 100, 0)).state is State.FORWARD


@pytest.mark.parametrize("angle", ["pitch", "roll"])
def test_each_angle_and_sign_beyond_the_limit_is_a_tilt(angle):
    for share, state in ((0.9, State.FORWARD), (1.1, State.TILT), (-1.1, State.TILT)):
        pose = dataclasses.replace(MIDDLE, **{angle: share * CONFIG.tilt_limit})
        assert exploring().tick(pose=pose).state is state


def test_turning_to_and_fro_on_one_spot_is_no_progress():
    """Each turn is progress for itself, and so is each change between FORWARD and STOP."""
    mission = exploring()
    states = []
    for time in np.arange(1.0, 1.5 * ON_ONE_SPOT, 0.1):
        pose = Pose(MIDDLE.x, MIDDLE.y, 2.0 * math.sin(0.8 * time))
        ahead = 0.5 if math.sin(0.4 * time) > 0 else 10.0
        states.append(mission.tick(pose=pose, ahead=ahead, plan=straight_plan(pose=pose)).state)
    assert {State.FORWARD, State.STOP} < set(states)
    assert states.index(State.STUCK) > 10 * 0.8 * ON_ONE_SPOT


def test_a_stop_from_which_no_way_leads_is_stuck():
    mission = exploring()
    poses = [dataclasses.replace(MIDDLE, yaw=0.1 * step) for step in range(100)]  # it turns
    states = [mission.tick(pose=pose, ahead=0.8, plan=None).state for pose in poses[:25]]
    assert set(states) == {State.STOP}
    for pose in poses[25:]:
        plan = straight_plan(pose=dataclasses.replace(pose, yaw=pose.yaw + 0.5))
        states.append(mission.tick(pose=pose, ahead=0.8, plan=plan).state)
    assert states.index(State.STUCK) == pytest.approx(10 * STOP_SECONDS, abs=2)


def test_plans_that_do_not_place_the_rover_never_end_the_exploration():
    mission = exploring()
    unplaced = dataclasses.replace(straight_plan(goal=False), placed=False)
    states = {mission.tick(plan=unplaced).state for _ in range(4 * PLANS_WITHOUT_GOAL)}
    assert State.RETURN_HOME not in states
    assert State.STUCK in states  # it moves, so that the map gets ground to plan on


def test_a_rover_that_is_enclosed_on_the_map_unblocks_and_has_not_explored_all():
    mission = DrivenMission()
    mission.tick_until(State.STUCK, 10.0)
    assert len(mission.mission.overlay().blocked) == 1
    mission.tick_until(State.FORWARD, 5.0)
    enclosed = dataclasses.replace(
        straight_plan(goal=False), home_path=NO_PATH, home_seconds=math.inf
    )
    states = []
    for step in range(60):
        pose = Pose(MIDDLE.x, MIDDLE.y, math.radians(5 * step))  # it looks around
        states.append(mission.tick(pose=pose, plan=enclosed, sample_count=0).state)
    assert State.RETURN_HOME not in states
    assert State.STUCK in states
    assert mission.mission.overlay().blocked == ()


def test_before_it_ends_with_samples_missing_blocked_places_are_tried_once_more():
    mission = DrivenMission()
    mission.tick_until(State.STUCK, 10.0)
    mission.tick_until(State.FORWARD, 5.0)
    empty = straight_plan(goal=False)

    def plans_until_home() -> int:
        for count in range(1, 100):
            pose = Pose(MIDDLE.x, MIDDLE.y, 0.5 * count)
            if mission.tick(pose=pose, plan=empty).state is State.RETURN_HOME:
                return count
        raise AssertionError("it explores for ever")

    assert len(mission.mission.overlay().blocked) == 1
    assert plans_until_home() == 2 * PLANS_WITHOUT_GOAL
    assert mission.mission.overlay().blocked == ()


def test_what_was_tilted_on_stays_blocked():
    mission = exploring()
    mission.tick(pose=TILTED)
    mission.tick_until(State.FORWARD, 10.0)
    empty = straight_plan(goal=False)
    for step in range(PLANS_WITHOUT_GOAL + 1):
        mission.tick(pose=Pose(MIDDLE.x, MIDDLE.y, 0.5 * step), plan=empty)
    assert len(mission.mission.overlay().blocked) == 1


def test_after_a_long_pause_it_goes_on_as_before():
    mission = exploring()
    mission.request(Request.PAUSE)
    assert {decision.state for decision in mission.ticks(60.0)} == {State.PAUSED}
    mission.request(Request.RESUME)
    states = {decision.state for decision in mission.ticks(0.95 * STALL_SECONDS, plan=PLAN)}
    assert states == {State.FORWARD}


def test_the_path_home_leaves_no_breadcrumbs():
    mission = exploring()
    for step in range(20):
        mission.tick(pose=Pose(MIDDLE.x + 0.3 * step, MIDDLE.y, 0.0))
    trail = mission.mission.overlay().breadcrumbs
    assert len(trail) == pytest.approx(10, abs=2)
    mission.request(Request.RETURN_HOME)
    for step in range(10):
        mission.tick(pose=Pose(MIDDLE.x + 5.7, MIDDLE.y + 0.3 * step, 0.0))
    assert mission.state is State.RETURN_HOME
    assert np.array_equal(mission.mission.overlay().breadcrumbs, trail)


def test_a_path_home_on_which_it_gets_stuck_again_is_left_for_the_next():
    mission = heading_home()
    far = Pose(MIDDLE.x + 5.0, MIDDLE.y, 0.0)
    methods = []
    for _ in range(2):
        methods.append(mission.tick(pose=far).reason)
        mission.tick_until(State.STUCK, 10.0, pose=far)
        mission.tick_until(State.RETURN_HOME, 10.0, pose=far)
    methods.append(mission.tick(pose=far).reason)
    assert methods[0] == methods[1]
    assert "breadcrumbs" in methods[0]
    assert "breadcrumbs" not in methods[2]
