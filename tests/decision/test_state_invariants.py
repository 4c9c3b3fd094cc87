"""What holds in each state, whatever the frames show: from every configuration of a mission."""

from __future__ import annotations

from collections.abc import Iterable

import pytest
from chart_model import EXPLORING, ChartModel, Phase
from frames_by_hand import AWAY, CONFIG, STEP, TILTED, DrivenMission
from maps import MIDDLE
from reached_states import REACHED, ROCK_AHEAD, reach

from rover_common.geometry import Pose
from rover_common.types import SAFE_COMMAND
from rover_decision.missions.sample_return.chart import State, transitions
from rover_decision.missions.sample_return.states import circle, hold, pickup, stop, tilt
from rover_decision.types import Decision, Request
from rover_navigation.recovery import RECOVERY_STEPS
from rover_navigation.types import PlanFailed

FIRST = {Phase.EXPLORING: State.FORWARD, Phase.HEADING_HOME: State.RETURN_HOME}
DRIVING = EXPLORING | {State.RETURN_HOME}
AT_REST = {State.IDLE, State.DONE, State.PAUSED, State.HOLD}
# frames that show nothing new, and all sorts of trouble and temptation
FRAMES = {
    "nothing": {},
    "a wall": {"ahead": 0.5},
    "no ground": {"ahead": 0.0},
    "a rock": {"rocks": ROCK_AHEAD},
    "a sample": {"near_sample": True},
    "a sample at speed": {"near_sample": True, "speed": 2.0},
    "the arm": {"picking_up": True, "near_sample": True},
    "a tilt": {"pose": TILTED},
    "a jump": {"pose": Pose(MIDDLE.x + 40.0, MIDDLE.y, 0.0)},
    "speed": {"speed": 3.0},
    "no plan": {"plan": None},
    "an old plan": {"plan_age": 10.0},
    "an old map": {"map_age": 10.0},
    "a failure": {"failure": PlanFailed(1, "it did not come")},
    "all collected": {"sample_count": 0},
}


def configurations(
    states: Iterable[State], phases: Iterable[Phase] = Phase
) -> pytest.MarkDecorator:
    """Parametrises a test over all configurations with these states, in these phases."""
    found = [at for at in REACHED if at.state in set(states) and at.phase in set(phases)]
    return pytest.mark.parametrize("at", found, ids=lambda at: f"{at.state.name}-{at.phase.name}")


def still(decision: Decision) -> bool:
    command = decision.command
    return (command.throttle, command.steering_angle, command.brake) == (0.0, 0.0, 1.0)


def test_every_configuration_of_the_chart_is_tested():
    reachable = set(ChartModel(transitions()).paths())
    assert set(REACHED) == reachable


@configurations(DRIVING)
@pytest.mark.parametrize("frame", FRAMES.values(), ids=FRAMES)
def test_missing_frames_stop_a_rover_that_drives(at, frame):
    mission = reach(at)
    mission.wait(2.0)
    decision = mission.tick(**({"pose": AWAY} | frame))
    if abs(frame.get("pose", MIDDLE).pitch) > 0.0:
        assert decision.state is State.TILT  # is more urgent, and brakes as well when it rolls
    elif frame.get("picking_up"):
        assert (decision.state, decision.command) == (State.PICKUP, SAFE_COMMAND)
    else:
        assert (decision.state, decision.command) == (State.HOLD, SAFE_COMMAND)


@configurations(AT_REST)
@pytest.mark.parametrize("frame", FRAMES.values(), ids=FRAMES)
def test_a_state_at_rest_never_moves(at, frame):
    mission = reach(at)
    for _ in range(5):
        decision = mission.tick(**frame)
        if decision.state in AT_REST:
            assert decision.command == SAFE_COMMAND
    if at.state in (State.PAUSED, State.DONE):
        assert decision.state is at.state


@configurations(set(State) - {State.PICKUP, State.PAUSED})
@pytest.mark.parametrize("frame", FRAMES.values(), ids=FRAMES)
def test_a_pause_holds_until_resume(at, frame):
    mission = reach(at)
    assert mission.request(Request.PAUSE)
    for after in (STEP, STEP, 60.0, STEP):
        decision = mission.tick(after, **frame)
        assert (decision.state, decision.command) == (State.PAUSED, SAFE_COMMAND)
    assert mission.request(Request.RESUME)
    assert mission.state is FIRST[at.phase]


@configurations({State.PICKUP})
def test_a_pickup_is_not_paused(at):
    mission = reach(at)
    assert not mission.request(Request.PAUSE)
    assert mission.tick(pose=AWAY, near_sample=True).state is State.PICKUP


@configurations(State)
def test_home_is_reached_from_everywhere(at):
    mission = reach(at)
    mission.request(Request.RETURN_HOME)
    mission.request(Request.RESUME)
    states = []
    for step in range(400):
        # it moves, or it would be stuck
        pose = Pose(AWAY.x - 0.05 * (step % 10), AWAY.y, 0.0) if step < 300 else MIDDLE
        states.append(mission.tick(pose=pose).state)
    assert states[-1] is State.DONE
    assert at.state is State.DONE or State.RETURN_HOME in states


@configurations(set(State) - {State.STUCK, State.TILT})
def test_the_arm_works_undisturbed(at):
    """Also one that somebody else has started."""
    mission = reach(at)
    mission.tick(pose=AWAY, picking_up=True)
    for _ in range(100):
        decision = mission.tick(pose=AWAY, picking_up=True)
        assert still(decision)
        assert not decision.command.pickup


@configurations(State)
@pytest.mark.parametrize("frame", FRAMES.values(), ids=FRAMES)
def test_a_pickup_is_only_asked_of_a_rover_that_stands_near_a_sample(at, frame):
    mission = reach(at)
    for _ in range(10):
        decision = mission.tick(**frame)
        if decision.command.pickup:
            assert decision.state is State.PICKUP
            assert frame.get("near_sample")
            assert abs(frame.get("speed", 0.0)) < 0.2
            assert still(decision)


@configurations({State.PICKUP, State.STUCK, State.TILT, State.HOLD, State.PAUSED})
def test_an_interruption_returns_to_the_phase_that_it_interrupted(at):
    mission = reach(at)
    mission.tick(pose=AWAY, picking_up=at.state is State.PICKUP)
    mission.request(Request.RESUME)
    driving = mission.tick_until(lambda made: made.state in DRIVING, 10.0, pose=AWAY)
    assert driving.state is FIRST[at.phase]


@configurations(State, {Phase.HEADING_HOME})
@pytest.mark.parametrize("frame", FRAMES.values(), ids=FRAMES)
def test_a_mission_that_heads_home_never_explores(at, frame):
    mission = reach(at)
    states = {mission.tick(**({"pose": AWAY} | frame)).state for _ in range(200)}
    mission.request(Request.RESUME)
    states |= {mission.tick(pose=AWAY).state for _ in range(100)}
    assert not states & EXPLORING
    assert states & {State.RETURN_HOME, State.DONE}


DEADLINES = {
    State.PICKUP: pickup.START_SECONDS,
    State.STUCK: max(step.seconds for step in RECOVERY_STEPS),
    State.TILT: tilt.DEADLINE,
    State.HOLD: hold.DEADLINE,
    State.STOP: stop.STOP_SECONDS,
    State.CIRCLE: circle.CIRCLE_SECONDS,
    State.ROCK_APPROACH: CONFIG.rock_deadline,
}
PERSISTENT = {  # what keeps the rover in each
    State.PICKUP: {"near_sample": True},
    State.STUCK: {"ahead": 0.5},
    State.TILT: {"pose": TILTED},
    State.HOLD: {"speed": 1.0},
    State.STOP: {"ahead": 0.5},
    State.CIRCLE: {},
    State.ROCK_APPROACH: {"rocks": ROCK_AHEAD},
}


@configurations(DEADLINES)
def test_no_state_but_driving_and_rest_lasts_for_ever(at):
    mission = reach(at)
    lasted = 0.0
    while mission.state is at.state:
        place = PERSISTENT[at.state].get("pose", AWAY)
        turning = Pose(place.x, place.y, 0.6 * mission.time, place.pitch)  # it is not stuck
        mission.tick(**(PERSISTENT[at.state] | {"pose": turning}))
        lasted += STEP
        assert lasted < DEADLINES[at.state] + 2 * STEP


def test_a_recovery_step_is_chosen_anew_until_none_is_left():
    mission = DrivenMission()
    for _ in range(2 * len(RECOVERY_STEPS)):
        mission.tick_until(lambda made: made.state in (State.STUCK, State.RETURN_HOME), 60.0)
        if mission.state is State.RETURN_HOME:
            return
        mission.tick_until(lambda made: made.state is not State.STUCK, 60.0)
        if mission.state in (State.RETURN_HOME, State.DONE):
            return
    raise AssertionError("it recovers for ever")
