"""What holds in each state, whatever the inputs show."""

from __future__ import annotations

import math
import pickle
from collections.abc import Iterable

import numpy as np
import pytest
from driven_heat import MIDDLE, RAMP_PITCH
from reached_heat import FAILURE, exploring, failed, holding, interrupted, reach

from rover_common.geometry import Pose
from rover_common.sensor_types import Twist
from rover_decision.types import Request
from rover_heat.mission.chart import State, transitions
from rover_heat.mission.ownership import STAND
from rover_heat.mission.states.hold import STANDS
from rover_navigation.plan_scheduler import PlanStatus

S = State
HOT = np.full((8, 8), 24.0, np.float32)
HOT[2:6, 2:6] += 9.0
FRAMES = {
    "nothing": {},
    "a tilt": {"pitch": RAMP_PITCH},
    "a roll": {"roll": 0.2},
    "heat": {"air": HOT},
    "a hot room": {"air": HOT + 60.0},
    "no scan": {"scans": ()},
    "no imu": {"imus": ()},
    "no pose": {"pose": None},
    "a jump": {"pose": Pose(MIDDLE.x + 0.9, MIDDLE.y, 0.0)},
    "no thermal": {"thermal": ()},
    "no map": {"grid": None},
    "slip": {"twist": Twist(0.2, 0.0)},
    "speed": {"twist": Twist(0.2, 0.5), "turn": 0.5},
    "no plan": {"plan": None},
    "an old plan": {"plan_age": 20.0},
    "a failure": {"failure": FAILURE},
    "a report": {"launches_done": 1},
}
AT_REST = (S.INITIALIZING, S.DONE, S.PAUSED, S.FAILED, S.HOLD)
DRIVING = (S.EXPLORING, S.GOAL_NAVIGATION, S.ATTEMPTING_RAMP, S.RETURNING)
INTERRUPTED = (*DRIVING, S.LAUNCHING)


def states(which: Iterable[State]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("state", which, ids=lambda state: state.name)


frames = pytest.mark.parametrize("frame", FRAMES.values(), ids=FRAMES)


@states(AT_REST)
@frames
def test_a_state_at_rest_never_moves_and_never_launches(state, frame):
    driven = reach(state)
    for _ in range(10):
        decision = driven.tick(**frame)
        if decision.state in AT_REST:
            assert decision.twist == STAND
        assert not decision.launch


@states(INTERRUPTED)
def test_a_tilt_stops_every_state_that_drives_at_the_tick_that_notices_it(state):
    driven = reach(state)
    decision = driven.until_state(S.TILT_INTERRUPT, 0.4, pitch=RAMP_PITCH)
    if state is not S.LAUNCHING:  # where it stands already
        assert decision.twist == STAND
        assert {made.twist for made in driven.ticks(0.45, pitch=RAMP_PITCH)} == {STAND}


@states(DRIVING)
def test_the_interrupt_works_every_time(state):
    driven = reach(state)
    for count in range(1, 4):
        decision = driven.until_state(S.TILT_INTERRUPT, 0.5, pitch=RAMP_PITCH)
        assert decision.progress.interrupts == count
        driven.until(lambda made: made.state is not S.TILT_INTERRUPT, 30.0)
        assert driven.state is state
        driven.ticks(0.5)


@states(DRIVING)
@pytest.mark.parametrize(
    ("silent", "limit"), [({"scans": ()}, 0.5), ({"imus": ()}, 0.3), ({"pose": None}, 1.0)],
    ids=["scan", "imu", "pose"],
)  # fmt: skip
def test_a_silent_input_stops_and_its_return_goes_on(state, silent, limit):
    driven = reach(state)
    begun = driven.time
    decision = driven.until_state(S.HOLD, limit + 0.3, **silent)
    assert limit - 0.11 <= driven.time - begun <= limit + 0.15
    (name,) = silent
    assert name.rstrip("s") in decision.reason
    assert decision.twist == STAND
    driven.ticks(5.0, **silent)
    driven.until(lambda made: made.state is not S.HOLD, 0.5)
    assert driven.state is state


@states(DRIVING)
def test_a_silent_input_is_a_failure_after_30_s(state):
    driven = holding(reach(state))
    driven.ticks(29.0, scans=())
    assert driven.state is S.HOLD
    assert "scan" in driven.until_state(S.FAILED, 2.0, scans=()).reason


@states(set(State) - {S.DONE, S.FAILED, S.PAUSED})
@frames
def test_a_pause_holds_until_resume(state, frame):
    driven = reach(state)
    before = driven.state
    assert driven.mission.request(Request.PAUSE)
    for _ in range(10):
        decision = driven.tick(**frame)
        assert (decision.state, decision.twist, decision.launch) == (S.PAUSED, STAND, False)
    assert driven.mission.request(Request.RESUME)
    interruptions = (S.TILT_INTERRUPT, S.HOLD)
    assert driven.state is (S.EXPLORING if before in interruptions else before)


@states(State)
@frames
def test_whatever_comes_it_keeps_its_limits_and_launches_only_standing_and_level(state, frame):
    driven = reach(state)
    for _ in range(20):
        decision = driven.tick(**frame)
        twist = decision.twist
        if twist is not None:
            assert abs(twist.linear) <= 0.22
            assert abs(twist.angular) <= 1.8
            assert math.isfinite(twist.linear + twist.angular)
        if decision.launch:
            assert (decision.state, twist) == (S.LAUNCHING, STAND)
            assert abs(frame.get("twist", STAND).linear) < STANDS
            assert "pitch" not in frame
            assert "roll" not in frame
    assert driven.launches <= 1


@states(State)
def test_a_recall_ends_every_state(state):
    driven = reach(state)
    driven.mission.request(Request.RETURN_HOME)
    assert driven.tick().state is S.DONE
    assert driven.mission.over


def test_a_failed_mission_goes_on_when_asked():
    driven = failed()
    assert driven.mission.request(Request.RESUME)
    driven.until_state(S.EXPLORING, 3.0)


@states(State)
@frames
def test_questions_change_nothing(state, frame):
    """`event` and `act` answer the same when asked twice."""
    driven = reach(state)
    driven.ticks(0.5, **frame)
    mission = driven.mission
    behavior = mission._states[mission.state]
    tick = mission._observe(driven.frame(**_of_frame(frame)), PlanStatus(None))
    behavior = mission._states[mission.state]
    before = pickle.dumps(vars(behavior))
    first = behavior.event(tick), behavior.act(tick)
    assert (behavior.event(tick), behavior.act(tick)) == first
    assert pickle.dumps(vars(behavior)) == before


def _of_frame(frame: dict) -> dict:
    return {k: v for k, v in frame.items() if k not in ("plan", "plan_age", "failure")}


@states(INTERRUPTED)
def test_each_trouble_that_a_state_watches_leads_out_of_it(state):
    watched = reach(state).mission._states[state]._watched()
    arrows = {(arrow.source, arrow.event.name) for arrow in transitions()}
    assert {trouble.name for trouble in watched} <= {name for s, name in arrows if s is state}


def test_an_interrupted_interruption_begins_anew():
    driven = interrupted(exploring())
    driven.until_state(S.HOLD, 1.0, imus=())
    assert driven.until(lambda made: made.state is not S.HOLD, 2.0).state is S.EXPLORING
