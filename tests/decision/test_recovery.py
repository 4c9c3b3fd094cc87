"""Obstacles, walls and the map's errors: how the mission gets into trouble, and out of it."""

import dataclasses
import math

import numpy as np
import pytest
from rover import MIDDLE, snapshot, straight_plan

from rover_common.geometry import Pose
from rover_decision.config import DecisionConfig
from rover_decision.events import PLANS_WITHOUT_GOAL
from rover_decision.memory import ON_ONE_SPOT, STOPS_HERE
from rover_decision.mission import Mission
from rover_decision.states import State
from rover_navigation.monitors import HELD_SECONDS, ProgressMonitor
from rover_navigation.recovery import LADDER
from rover_navigation.types import NO_WAY

CONFIG = DecisionConfig()
PLAN = straight_plan()


def test_the_faster_it_drives_the_more_room_it_needs():
    def state(ahead: float, speed: float) -> State:
        mission = Mission(CONFIG)
        mission.tick(snapshot(1.0))
        return mission.tick(snapshot(1.1, ahead=ahead, speed=speed, plan=PLAN)).state

    assert state(1.2, speed=0.4) is State.FORWARD
    assert state(1.2, speed=2.0) is State.STOP
    assert state(3.0, speed=2.0) is State.FORWARD


def test_too_near_to_an_obstacle_for_the_way_it_backs_up_and_goes_on():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0))
    for time in np.arange(1.1, 3.0, 0.1):
        near = mission.tick(snapshot(time, ahead=0.8, plan=PLAN))
    assert near.state is State.STOP
    assert near.command.throttle < 0
    away = mission.tick(snapshot(3.0, pose=Pose(99.6, 100.0, 0.0), ahead=1.2, plan=PLAN))
    assert away.state is State.FORWARD
    assert away.command.throttle > 0


def test_where_it_stops_again_and_again_the_way_is_blocked():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0))
    time, stops = 1.0, 0
    while stops < STOPS_HERE:
        for ahead in (0.8, 1.2):  # it backs up and sets out again
            before = mission.state
            for _ in range(8):
                time += 0.1
                mission.tick(snapshot(time, ahead=ahead, plan=PLAN))
            stops += mission.state is State.STOP and before is not State.STOP
        assert len(mission.memory.blocked) == (stops == STOPS_HERE)
    (place,) = mission.memory.blocked
    assert place.x > MIDDLE.x
    assert math.isfinite(place.until)


def test_a_rover_that_is_held_is_stuck_soon_and_one_that_waits_is_not():
    mission = Mission(CONFIG)
    waiting = [mission.tick(snapshot(1.0 + 0.1 * step)).state for step in range(25)]
    assert State.STUCK not in waiting  # for the first plan, with the brake on
    driving = [mission.tick(snapshot(3.5 + 0.1 * step, plan=PLAN)).state for step in range(30)]
    assert driving.index(State.STUCK) == pytest.approx(10 * HELD_SECONDS, abs=2)


def test_no_progress_is_stuck_and_leads_to_backing_up_and_in_the_end_home():
    mission = Mission(CONFIG)
    decisions, blocked = [], False
    for step in range(1500):
        decisions.append(mission.tick(snapshot(1.0 + 0.1 * step, plan=PLAN)))
        blocked |= len(mission.memory.blocked) > 0
    stuck = [decision for decision in decisions if decision.state is State.STUCK]
    assert stuck[0].command.throttle < 0
    assert blocked
    last = decisions[-1]
    assert last.progress.recoveries > len(LADDER)
    assert any("home" in decision.reason for decision in decisions) or last.state is State.DONE


def test_a_tilt_stops_backs_off_and_marks_the_place():
    mission = Mission(CONFIG)
    for step in range(10):
        mission.tick(snapshot(1.0 + 0.1 * step, Pose(99.0 + 0.1 * step, 100, 0), plan=PLAN))
    leaning = Pose(100, 100, 0, pitch=-0.3)
    fast = mission.tick(snapshot(2.0, pose=leaning, speed=1.0, plan=PLAN))
    assert fast.state is State.TILT
    assert fast.command.brake == 1.0
    assert mission.tick(snapshot(2.1, pose=leaning, plan=PLAN)).command.throttle < 0
    (place,) = mission.memory.blocked
    assert place.until == math.inf
    level = Pose(99.2, 100, 0)
    assert mission.tick(snapshot(3.0, pose=level, plan=PLAN)).state is State.FORWARD


def test_to_turn_to_and_fro_on_one_spot_is_no_progress():
    """Each turn is progress for itself, and so is each change between FORWARD and STOP."""
    mission = Mission(CONFIG)
    states = []
    for time in np.arange(1.0, 1.5 * ON_ONE_SPOT, 0.1):
        yaw = 2.0 * math.sin(0.8 * time)
        ahead = 0.5 if math.sin(0.4 * time) > 0 else 10.0
        plan = straight_plan(pose=Pose(MIDDLE.x, MIDDLE.y, yaw))
        pose = Pose(MIDDLE.x, MIDDLE.y, yaw)
        states.append(mission.tick(snapshot(time, pose, ahead, plan=plan)).state)
    assert {State.FORWARD, State.STOP} < set(states)
    assert states.index(State.STUCK) > 10 * 0.8 * ON_ONE_SPOT


def test_stuck_needs_the_whole_span():
    monitor = ProgressMonitor(5.0)
    for step in range(49):
        monitor.update(0.1 * step, Pose(0, 0, 0))
    assert not monitor.stuck()
    for step in range(49, 55):
        monitor.update(0.1 * step, Pose(0, 0, 0))
    assert monitor.stuck()
    monitor.restart()
    assert not monitor.stuck()


def test_a_plan_that_cannot_place_the_rover_never_ends_the_exploration():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0, plan=PLAN))
    states = set()
    for index in range(4 * PLANS_WITHOUT_GOAL):
        unplaced = dataclasses.replace(straight_plan(stamp=1 + index, goal=False), placed=False)
        decision = mission.tick(snapshot(1.5 + 0.1 * index, plan=unplaced))
        states.add(decision.state)
    assert State.RETURN_HOME not in states
    assert State.STUCK in states  # it moves, so that the map gets ground to plan on


def test_a_rover_that_is_shut_in_on_the_map_has_not_explored_all():
    mission = Mission(CONFIG)
    shut_in = dataclasses.replace(straight_plan(goal=False), home_way=NO_WAY, home_seconds=math.inf)
    mission.tick(snapshot(1.0))
    mission.memory.block_ahead(1.0, MIDDLE)
    states = []
    for step in range(60):
        yaw = math.radians(5 * step)  # it looks around
        now = snapshot(1.1 + 0.1 * step, Pose(MIDDLE.x, MIDDLE.y, yaw), sample_count=0,
            plan=dataclasses.replace(shut_in, stamp=1 + step))  # fmt: skip
        states.append(mission.tick(now).state)
    assert State.RETURN_HOME not in states
    assert State.STUCK in states
    assert mission.memory.blocked == ()
