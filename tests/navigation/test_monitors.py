"""Monitors: no progress, stalls, circles, and what lies between two frames."""

import math

import numpy as np
import pytest
from maps import SCALE

from rover_common.geometry import Pose
from rover_common.types import SAFE_COMMAND, Command
from rover_navigation.monitors import (
    CIRCLE_SECONDS,
    CIRCLE_STEERING,
    ON_ONE_SPOT,
    STALL_SECONDS,
    CircleMonitor,
    InputMonitor,
    MotionMonitor,
    ProgressChecker,
    StallMonitor,
)

HERE = Pose(0.0, 0.0, 0.0)
DRIVE = Command(throttle=0.5)


def test_stuck_needs_the_whole_span():
    checker = ProgressChecker(5.0, 0.5)
    for step in range(49):
        checker.update(0.1 * step, HERE)
    assert not checker.stuck()
    for step in range(49, 55):
        checker.update(0.1 * step, HERE)
    assert checker.stuck()
    checker.restart()
    assert not checker.stuck()


@pytest.mark.parametrize(("turns_count", "stuck"), [(True, False), (False, True)])
def test_a_turn_in_place_is_progress_where_turns_count(turns_count, stuck):
    checker = ProgressChecker(5.0, 0.5, turns_count)
    for step in range(60):
        checker.update(0.1 * step, Pose(0.0, 0.0, 0.2 * step))
    assert checker.stuck() is stuck


def stalled_after(command: Command, speed: float = 0.0, turn_rate: float = 0.0) -> float:
    """[s] from the first command until the stall shows; inf when it does not."""
    monitor = StallMonitor(SCALE.stall_distance)
    for time in np.arange(0.0, 2 * STALL_SECONDS, 0.1):
        monitor.commanded(float(time), Pose(speed * time, 0.0, turn_rate * time), command)
        if monitor.stalled(float(time)):
            return float(time)
    return math.inf


def test_a_robot_that_is_told_to_move_and_does_not_is_stalled():
    turn = Command(steering_angle=0.2)
    assert stalled_after(DRIVE) == pytest.approx(STALL_SECONDS, abs=0.2)
    assert stalled_after(turn) == pytest.approx(STALL_SECONDS, abs=0.2)
    assert stalled_after(DRIVE, speed=0.1) == math.inf
    assert stalled_after(turn, turn_rate=0.1) == math.inf
    assert stalled_after(SAFE_COMMAND) == math.inf
    assert stalled_after(Command(steering_angle=0.2, brake=1.0)) == math.inf  # it cannot turn


def test_turning_to_and_fro_on_one_spot_is_no_progress():
    monitor = MotionMonitor(6.0, SCALE)
    stopped = []
    for time in np.arange(0.0, ON_ONE_SPOT + 5.0, 0.1):
        pose = Pose(0.0, 0.0, 2.0 * math.sin(0.8 * time))
        monitor.update(float(time), pose)
        if monitor.stopped_moving(float(time)):
            stopped.append(float(time))
        monitor.commanded(float(time), pose, Command(steering_angle=0.2))
        monitor.restart(float(time), may_stay=False)
    assert stopped[0] == pytest.approx(ON_ONE_SPOT, abs=0.2)


def test_a_restart_lets_the_robot_stay_where_it_may():
    monitor = MotionMonitor(6.0, SCALE)
    for time in np.arange(0.0, 3 * ON_ONE_SPOT, 0.1):
        monitor.update(float(time), HERE)
        monitor.restart(float(time), may_stay=True)
        assert not monitor.stopped_moving(float(time))


def circling_after(steering: float, driving: bool = True) -> float:
    monitor = CircleMonitor()
    for time in np.arange(0.0, 2 * CIRCLE_SECONDS, 0.1):
        monitor.commanded(float(time), steering, driving)
        if monitor.circling(float(time)):
            return float(time)
    return math.inf


def test_steering_to_one_side_for_long_is_a_circle():
    assert circling_after(0.2) == pytest.approx(CIRCLE_SECONDS, abs=0.2)
    assert circling_after(-0.2) == pytest.approx(CIRCLE_SECONDS, abs=0.2)
    assert circling_after(0.9 * CIRCLE_STEERING) == math.inf
    assert circling_after(0.2, driving=False) == math.inf


def test_a_turn_to_the_other_side_ends_a_circle():
    monitor = CircleMonitor()
    for step in range(200):
        monitor.commanded(0.1 * step, 0.2, driving=True)
    assert monitor.circling(20.0)
    monitor.commanded(20.1, -0.2, driving=True)
    assert not monitor.circling(20.2)


def test_gaps_jumps_and_the_distance_are_measured_between_frames():
    monitor = InputMonitor()
    monitor.update(500.0, Pose(50.0, 50.0, 0.0))
    assert (monitor.gap, monitor.jump, monitor.distance) == (0.0, 0.0, 0.0)
    monitor.update(500.1, Pose(50.3, 50.4, 1.0))
    assert monitor.gap == pytest.approx(0.1)
    assert monitor.jump == monitor.distance == pytest.approx(0.5)
    monitor.update(503.1, Pose(50.3, 50.4, 1.0))
    assert (monitor.gap, monitor.jump) == (pytest.approx(3.0), 0.0)
    assert monitor.distance == pytest.approx(0.5)
