"""What a person may ask the mission for."""

from __future__ import annotations

import pytest
from frames_by_hand import (
    AWAY,
    TILTED,
    DrivenMission,
    exploring,
    heading_home,
    over,
    rock,
)
from maps import MIDDLE

from rover_common.types import SAFE_COMMAND
from rover_decision.missions.sample_return.chart import State
from rover_decision.types import Request


def test_pause_and_resume():
    mission = exploring()
    assert mission.request(Request.PAUSE)
    paused = mission.tick()
    assert (paused.state, paused.command) == (State.PAUSED, SAFE_COMMAND)
    assert not mission.request(Request.PAUSE)
    assert mission.request(Request.RESUME)
    assert mission.tick().state is State.FORWARD
    assert not mission.request(Request.RESUME)


def test_a_pause_before_the_first_frame_holds():
    mission = DrivenMission()
    assert mission.request(Request.PAUSE)
    assert mission.tick().command == SAFE_COMMAND
    assert mission.request(Request.RESUME)
    assert mission.tick().state is State.FORWARD


def test_a_request_to_return_home_turns_an_exploring_rover_at_once():
    mission = exploring()
    mission.tick(pose=AWAY)
    assert mission.request(Request.RETURN_HOME)
    assert mission.state is State.RETURN_HOME
    assert mission.tick(pose=AWAY).state is State.RETURN_HOME
    assert mission.request(Request.RETURN_HOME)  # again, and it is still on its way
    assert mission.tick().state is State.DONE
    assert not mission.request(Request.RETURN_HOME)


def test_a_request_to_return_home_before_the_first_frame_is_remembered():
    mission = DrivenMission()
    assert mission.request(Request.RETURN_HOME)
    states = [mission.tick().state for _ in range(3)]
    assert states[-1] is State.DONE


def test_a_start_before_the_first_frame_takes_a_request_to_return_home_back():
    mission = DrivenMission()
    mission.request(Request.RETURN_HOME)
    assert mission.request(Request.START)
    states = {mission.tick().state for _ in range(3)}
    assert states == {State.FORWARD}


@pytest.mark.parametrize(
    ("busy", "then"),
    [
        ({"near_sample": True}, {"sample_count": 2}),
        ({"pose": TILTED}, {}),
        ({"rocks": (rock(103.0, 100.0),)}, {}),
    ],
    ids=["pickup", "tilt", "approach"],
)
def test_what_cannot_be_left_at_once_is_finished_before_coming_home(busy, then):
    mission = exploring()
    mission.tick(pose=AWAY)
    state = mission.tick(**({"pose": AWAY} | busy)).state
    assert state in (State.PICKUP, State.TILT, State.ROCK_APPROACH)
    mission.request(Request.RETURN_HOME)
    assert mission.state in (state, State.RETURN_HOME)
    mission.tick_until(State.RETURN_HOME, 10.0, pose=AWAY, **then)
    assert mission.tick(**then).state is State.DONE


def test_on_a_requested_return_no_rock_is_approached():
    mission = exploring()
    mission.tick(near_sample=True)
    mission.request(Request.RETURN_HOME)
    mission.tick(picking_up=True, pose=AWAY)
    near = (rock(AWAY.x + 3.0, MIDDLE.y),)
    states = {mission.tick(pose=AWAY, rocks=near, sample_count=2).state for _ in range(10)}
    assert State.ROCK_APPROACH not in states
    assert State.RETURN_HOME in states


def test_a_pause_on_the_path_home_goes_on_home():
    mission = heading_home()
    mission.request(Request.PAUSE)
    mission.ticks(5.0, pose=AWAY)
    mission.request(Request.RESUME)
    assert mission.tick(pose=AWAY).state is State.RETURN_HOME


def test_a_return_that_is_requested_in_a_pause_begins_after_it():
    mission = exploring()
    mission.request(Request.PAUSE)
    mission.request(Request.RETURN_HOME)
    assert mission.tick(pose=AWAY).state is State.PAUSED
    mission.request(Request.RESUME)
    states = [mission.tick(pose=AWAY).state for _ in range(3)]
    assert states[-1] is State.RETURN_HOME


def test_a_mission_that_is_over_stays_over():
    mission = over()
    for request in (Request.RESUME, Request.RETURN_HOME, Request.START):
        assert not mission.request(request)
    far = {"pose": AWAY, "near_sample": True, "rocks": (rock(103.0, 100.0),)}
    for decision in mission.ticks(5.0, **far):
        assert (decision.state, decision.command) == (State.DONE, SAFE_COMMAND)
