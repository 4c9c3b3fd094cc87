"""What a goal to run the mission asks of it, and how it ends."""

from __future__ import annotations

import dataclasses
import math

import pytest
from cores import CoreBench
from frames_by_hand import AWAY, PLAN, TILTED
from maps import MIDDLE
from rover_interfaces.action import RunMission

from rover_common.geometry import Pose
from rover_decision.mission_goal import MissionGoal, Outcome, refusal
from rover_decision.missions.sample_return.chart import State
from rover_decision.types import Request


@pytest.fixture
def bench(make_bench) -> CoreBench:
    return make_bench()


@pytest.fixture
def running(bench) -> CoreBench:
    """Its mission explores since the time 1.0 s."""
    bench.step()
    assert bench.core.state is State.FORWARD
    return bench


@pytest.fixture
def over(running) -> CoreBench:
    running.core.request(Request.RETURN_HOME)
    running.step()
    assert running.core.state is State.DONE
    return running


def test_a_running_mission_is_followed_to_its_end(running):
    goal = MissionGoal(running.core)
    assert goal.outcome() is None
    assert running.step().progress.elapsed == pytest.approx(0.1)
    running.core.request(Request.RETURN_HOME)
    assert goal.outcome() is None
    running.step()
    assert goal.outcome() is Outcome.HOME


def test_a_mission_that_is_over_starts_again_with_a_new_run(over):
    goal = MissionGoal(over.core)
    assert goal.outcome() is None
    over.time = 50.0
    assert over.step().command.new_run
    assert goal.outcome() is None
    over.begin_run()
    decision = over.step()
    assert (decision.state, decision.progress.elapsed) == (State.FORWARD, 0.0)
    assert goal.outcome() is None


def test_a_canceled_goal_comes_home(running):
    goal = MissionGoal(running.core)
    running.step(pose=AWAY)
    goal.cancel()
    assert running.step(pose=AWAY).state is State.RETURN_HOME
    assert goal.outcome() is None
    running.step()
    assert goal.outcome() is Outcome.CANCELED


@pytest.mark.parametrize(
    ("busy", "then"),
    [({"near_sample": True}, {"sample_count": 2}), ({"pose": TILTED}, {})],
    ids=["pickup", "tilt"],
)
def test_a_canceled_goal_finishes_what_cannot_be_left_at_once(running, busy, then):
    goal = MissionGoal(running.core)
    state = running.step(**busy).state
    assert state in (State.PICKUP, State.TILT)
    goal.cancel()
    assert running.core.state is state
    states = [running.step(0.5, **then).state for _ in range(20)]
    assert states[-1] is State.DONE
    assert State.RETURN_HOME in states
    assert goal.outcome() is Outcome.CANCELED


def test_a_paused_mission_comes_home_after_its_pause(running):
    goal = MissionGoal(running.core)
    running.core.request(Request.PAUSE)
    goal.cancel()
    assert running.step().state is State.PAUSED
    assert goal.outcome() is None
    running.core.request(Request.RESUME)
    running.step()
    running.step()
    assert goal.outcome() is Outcome.CANCELED


def test_canceled_before_the_first_frame_the_rover_stays(bench):
    goal = MissionGoal(bench.core)
    goal.cancel()
    assert goal.outcome() is Outcome.CANCELED
    assert [bench.step().state for _ in range(3)][-1] is State.DONE


def test_a_goal_after_one_that_was_canceled_before_the_first_frame_runs(bench):
    MissionGoal(bench.core).cancel()
    again = MissionGoal(bench.core)
    bench.step()
    assert bench.step().state is State.FORWARD
    assert again.outcome() is None


@pytest.mark.parametrize("begun", ["idle", "running", "over"])
def test_a_time_limit_counts_for_this_mission_only(bench, request, begun):
    if begun != "idle":
        request.getfixturevalue(begun)
    MissionGoal(bench.core, time_limit=5.0)
    start = 1.0
    if begun != "running":
        start = bench.time = 100.0
    if begun == "over":
        bench.begin_run()

    bench.planner.plan = dataclasses.replace(PLAN, home_seconds=math.inf)  # no time is reserved

    def state_at(elapsed: float) -> State:
        bench.time = start + elapsed
        to_and_fro = Pose(MIDDLE.x + elapsed % 1.8, MIDDLE.y, 0.0)
        return bench.step(pose=to_and_fro).state

    assert {state_at(0.9 * step) for step in range(6)} == {State.FORWARD}
    assert state_at(5.1) is State.RETURN_HOME
    assert state_at(5.4) is State.DONE
    bench.core.request(Request.START)
    start = bench.time = 200.0
    bench.begin_run()
    assert {state_at(0.9 * step) for step in range(7)} == {State.FORWARD}


def test_a_new_mission_ends_the_goal_of_the_one_before(running):
    goal = MissionGoal(running.core)
    running.core.request(Request.RESET)
    assert goal.outcome() is Outcome.RESTARTED
    goal = MissionGoal(running.core)
    running.step()
    running.begin_run()
    running.step()
    assert goal.outcome() is None
    running.begin_run()  # the simulator has started anew
    running.step()
    assert goal.outcome() is Outcome.RESTARTED


def test_one_goal_at_a_time_and_sensible_limits(running):
    goal = MissionGoal(running.core)
    assert refusal(0.0, None) == refusal(600.0, None) == ""
    for nonsense in (-1.0, math.nan, math.inf):
        assert "time_limit" in refusal(nonsense, None)
    assert "already" in refusal(0.0, goal)
    goal.cancel()
    assert "heads home" in refusal(0.0, goal)


def test_outcomes_are_those_of_the_action():
    for outcome in set(Outcome) - {Outcome.FAILED}:  # which this mission knows no way to
        assert getattr(RunMission.Result, outcome.name) == outcome.value
    assert RunMission.Result().outcome == RunMission.Result.UNKNOWN == 0
