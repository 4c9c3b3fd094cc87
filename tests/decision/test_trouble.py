"""Detectors of trouble, and what missing frames and jumps do."""

from __future__ import annotations

from dataclasses import replace

import pytest
from frames_by_hand import exploring
from maps import MIDDLE

from rover_common.geometry import Pose
from rover_common.types import SAFE_COMMAND
from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.states import GAP_SECONDS, JUMP
from rover_decision.trouble import (
    DETECTORS,
    INPUTS,
    MOTION,
    Health,
    Limits,
    Trouble,
    first_trouble,
)
from rover_navigation.types import PlanFailed

LIMITS = Limits(tilt=0.16, gap=1.0, jump=3.0, plan_age=3.0, map_age=3.0, clock_error=0.5,
                navigator_silent=0.5)  # fmt: skip
WELL = Health(tilt=0.15, gap=0.1, jump=0.1, stopped_moving=False, plan_age=0.5, map_age=0.5,
              plan_failure=None)  # fmt: skip
FAULTS = {
    Trouble.tilted: {"tilt": 0.17},
    Trouble.input_gap: {"gap": 1.01},
    Trouble.clock_apart: {"clock_error": 0.51},
    Trouble.navigator_lost: {"navigator_silent": 0.51},
    Trouble.stopped_moving: {"stopped_moving": True},
    Trouble.planner_failed: {"plan_failure": PlanFailed(1, "it did not come")},
    Trouble.plan_stale: {"plan_age": 3.01},
    Trouble.map_stale: {"map_age": 3.01},
}


def test_all_is_well_within_the_limits():
    assert first_trouble(WELL, LIMITS, Trouble) is None


@pytest.mark.parametrize("trouble", Trouble)
def test_each_trouble_is_found_where_it_is_watched_for(trouble):
    ill = replace(WELL, **FAULTS[trouble])
    assert first_trouble(ill, LIMITS, Trouble) is trouble
    assert first_trouble(ill, LIMITS, set(Trouble) - {trouble}) is None


def test_the_most_urgent_trouble_comes_first():
    ill = WELL
    for trouble in reversed(Trouble):
        ill = replace(ill, **FAULTS[trouble])
        assert first_trouble(ill, LIMITS, Trouble) is trouble


def test_a_jump_of_the_pose_is_a_gap_of_the_input():
    assert first_trouble(replace(WELL, jump=3.1), LIMITS, Trouble) is Trouble.input_gap


def test_each_trouble_of_the_rover_is_an_event_that_says_the_same():
    for trouble in MOTION | INPUTS:
        assert Event[trouble.name].value == trouble.value
    assert set(DETECTORS) == set(Trouble)


@pytest.mark.parametrize(
    ("after", "pose"),
    [(GAP_SECONDS + 0.1, MIDDLE), (0.1, Pose(MIDDLE.x + JUMP + 0.1, MIDDLE.y, 0.0))],
    ids=["gap", "jump"],
)
def test_missing_frames_and_jumps_stop_it_until_it_stands(after, pose):
    mission = exploring()
    mission.tick(after)
    held = mission.tick(pose=pose, speed=1.0)
    assert (held.state, held.command) == (State.HOLD, SAFE_COMMAND)
    assert mission.tick(pose=pose, speed=0.5).command == SAFE_COMMAND  # it still rolls
    assert mission.tick(pose=pose).state is State.FORWARD


def test_short_gaps_and_steps_are_driven_through():
    mission = exploring()
    mission.tick(0.9 * GAP_SECONDS)
    assert mission.tick(pose=Pose(MIDDLE.x + 0.9 * JUMP, MIDDLE.y, 0.0)).state is State.FORWARD
