"""What a request to run the mission asks of it, and how it ends."""

import math

import pytest
from rover import MIDDLE, snapshot, straight_plan
from rover_interfaces.action import RunMission

from rover_common.geometry import Pose
from rover_decision.config import DecisionConfig
from rover_decision.mission import Mission
from rover_decision.run import Outcome, Run, refusal
from rover_decision.states import State

CONFIG = DecisionConfig()
PLAN = straight_plan()
LEANING = Pose(MIDDLE.x, MIDDLE.y, MIDDLE.yaw, pitch=-0.3)


def running() -> Mission:
    """A mission that explores since the time 1.0 s."""
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0, plan=PLAN))
    assert mission.state is State.FORWARD
    return mission


def over() -> Mission:
    mission = running()
    mission.return_home()
    mission.tick(snapshot(1.1))
    assert mission.state is State.DONE
    return mission


def test_a_running_mission_is_followed_to_its_end():
    mission = running()
    run = Run(mission)
    assert run.outcome() is None
    assert mission.tick(snapshot(1.1)).progress.elapsed == pytest.approx(0.1)
    mission.return_home()
    assert run.outcome() is None
    mission.tick(snapshot(1.2))
    assert run.outcome() is Outcome.HOME


def test_a_mission_that_is_over_starts_again():
    mission = over()
    run = Run(mission)
    assert run.outcome() is None
    decision = mission.tick(snapshot(50.0))
    assert (decision.state, decision.progress.elapsed) == (State.FORWARD, 0.0)
    assert run.outcome() is None


def test_to_cancel_is_to_come_home():
    mission = running()
    run = Run(mission)
    away = Pose(MIDDLE.x + 2.9, MIDDLE.y, 0.0)
    mission.tick(snapshot(1.1, away))
    run.cancel()
    assert mission.tick(snapshot(1.2, away)).state is State.RETURN_HOME
    assert run.outcome() is None
    mission.tick(snapshot(1.3))
    assert run.outcome() is Outcome.CANCELED


@pytest.mark.parametrize(
    ("busy", "then"),
    [
        ({"near_sample": True}, {"near_sample": False, "sample_count": 2}),
        ({"pose": LEANING}, {}),
    ],
    ids=["pickup", "tilt"],
)
def test_what_cannot_be_left_at_once_is_finished_before_coming_home(busy, then):
    mission = running()
    run = Run(mission)
    state = mission.tick(snapshot(1.1, **busy)).state
    assert state in (State.PICKUP, State.TILT)
    run.cancel()
    assert mission.state is state
    states = [mission.tick(snapshot(1.6 + 0.5 * step, **then)).state for step in range(20)]
    assert states[-1] is State.DONE
    assert State.RETURN_HOME in states
    assert run.outcome() is Outcome.CANCELED


def test_a_pause_holds_and_the_way_home_comes_after_it():
    mission = running()
    run = Run(mission)
    mission.pause()
    run.cancel()
    assert mission.tick(snapshot(1.1)).state is State.PAUSED
    assert run.outcome() is None
    mission.resume()
    mission.tick(snapshot(1.2))
    mission.tick(snapshot(1.3))
    assert run.outcome() is Outcome.CANCELED


def test_canceled_before_the_first_frame_the_rover_stays():
    mission = Mission(CONFIG)
    run = Run(mission)
    run.cancel()
    assert run.outcome() is Outcome.CANCELED
    for step in range(3):
        state = mission.tick(snapshot(1.0 + 0.1 * step)).state
    assert state is State.DONE
    mission = Mission(CONFIG)
    Run(mission).cancel()
    again = Run(mission)
    mission.tick(snapshot(1.0))
    assert mission.tick(snapshot(1.1)).state is State.FORWARD
    assert again.outcome() is None


@pytest.mark.parametrize("make", [Mission, lambda _: running(), lambda _: over()])
def test_the_time_limit_counts_for_this_mission_only(make):
    mission = make(CONFIG)
    Run(mission, time_limit=5.0)
    start = 1.0 if mission.state is State.FORWARD else 100.0

    def state_at(elapsed: float) -> State:
        return mission.tick(snapshot(start + elapsed, plan=None)).state

    before = [state_at(0.9 * step) for step in range(6)]
    assert set(before) == {State.FORWARD}
    assert state_at(5.1) is State.RETURN_HOME
    assert state_at(5.2) is State.DONE
    mission.start()
    start = 200.0
    assert {state_at(0.9 * step) for step in range(7)} == {State.FORWARD}


def test_a_new_mission_ends_the_run_of_the_one_before():
    mission = running()
    run = Run(mission)
    mission.reset()
    assert run.outcome() is Outcome.RESTARTED
    run = Run(mission)
    mission.tick(snapshot(500.0))
    assert run.outcome() is None
    mission.tick(snapshot(1.0))  # the simulator has started anew
    assert run.outcome() is Outcome.RESTARTED


def test_one_run_at_a_time_and_sensible_limits():
    run = Run(running())
    assert refusal(0.0, None) == refusal(600.0, None) == ""
    for nonsense in (-1.0, math.nan, math.inf):
        assert "time_limit" in refusal(nonsense, None)
    assert "already" in refusal(0.0, run)
    run.cancel()
    assert "way home" in refusal(0.0, run)


def test_outcomes_are_those_of_the_action():
    for outcome in Outcome:
        assert getattr(RunMission.Result, outcome.name) == outcome.value
    assert RunMission.Result().outcome == RunMission.Result.UNKNOWN == 0
