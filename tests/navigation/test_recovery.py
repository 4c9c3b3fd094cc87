"""Recovery: the sequence of manoeuvres, and the way back to level ground."""

import math

import pytest
from maps import SCALE

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_navigation.actuation import Actuation
from rover_navigation.recovery import (
    RECOVERY_STEPS,
    RecoverySequence,
    SafePoses,
    back_to,
)

ACTUATION = Actuation(ROVER)
HERE = Pose(10.0, 10.0, 0.0)
LEFT, RIGHT = 1, -1


def test_the_steps_follow_each_other_until_the_sequence_is_exhausted():
    sequence = RecoverySequence(ACTUATION, SCALE.clear_distance)
    for step in RECOVERY_STEPS:
        sequence.advance(HERE, LEFT)
        assert sequence.step == step
        assert not sequence.exhausted
    sequence.advance(HERE, LEFT)
    assert sequence.exhausted


def test_clear_of_the_place_the_sequence_begins_anew():
    sequence = RecoverySequence(ACTUATION, SCALE.clear_distance)
    for _ in RECOVERY_STEPS:
        sequence.advance(HERE, LEFT)
    sequence.advance(Pose(HERE.x + 1.1 * SCALE.clear_distance, HERE.y, 0.0), LEFT)
    assert sequence.step == RECOVERY_STEPS[0]


def test_the_first_turn_goes_to_the_wider_side_and_the_next_to_the_other():
    sequence = RecoverySequence(ACTUATION, SCALE.clear_distance)
    turns = []
    for _ in range(3):
        sequence.advance(HERE, RIGHT)
        command, _ = sequence.command(0.0, sequence.step.back + 0.1)
        turns.append(math.copysign(1.0, command.steering_angle))
        assert command.throttle == command.brake == 0.0
    assert turns == [-1.0, 1.0, -1.0]


def test_a_step_backs_up_turns_and_drives_out():
    sequence = RecoverySequence(ACTUATION, SCALE.clear_distance)
    for _ in range(3):
        sequence.advance(HERE, LEFT)
    step = sequence.step
    assert step.push > 0
    back, _ = sequence.command(0.0, 0.5 * step.back)
    assert back.throttle < 0
    assert back.steering_angle < 0  # so that it faces the wider side afterwards
    push, _ = sequence.command(0.0, step.back + step.turn + 0.5 * step.push)
    assert push.throttle > 0


def test_a_safe_pose_is_level_and_far_enough_behind():
    poses = SafePoses(0.08, SCALE)
    assert poses.target(HERE) is None
    for step in range(20):
        pitch = -0.2 if step >= 15 else 0.0
        poses.update(Pose(10.0 + 0.1 * step, 10.0, 0.0, pitch=pitch))
    tilted = Pose(11.9, 10.0, 0.0, pitch=-0.2)
    target = poses.target(tilted)
    assert target.pitch == 0.0
    assert tilted.x - target.x == pytest.approx(SCALE.back_distance, abs=0.3)
    assert tilted.x - target.x > SCALE.back_distance


def test_it_brakes_and_backs_to_the_safe_pose():
    safe = Pose(9.0, 10.0, 0.0)
    assert back_to(safe, HERE, 1.0, ACTUATION).brake == 1.0
    assert back_to(safe, HERE, 0.0, ACTUATION).throttle < 0
    assert back_to(None, HERE, 0.0, ACTUATION).throttle < 0
    assert back_to(Pose(11.0, 10.0, 0.0), HERE, 0.0, ACTUATION).throttle > 0  # it slid past it
    poses = SafePoses(0.08, SCALE)
    assert poses.reached(safe, Pose(9.2, 10.0, 0.0))
    assert not poses.reached(safe, HERE)
    assert not poses.reached(None, HERE)


def test_backing_up_steers_the_tail_to_the_safe_pose():
    """A point behind to the left: wheels to the left swing the tail there, and the nose right."""
    left = back_to(Pose(8.0, 11.0, 0.0), HERE, 0.0, ACTUATION)
    right = back_to(Pose(8.0, 9.0, 0.0), HERE, 0.0, ACTUATION)
    assert left.throttle < 0
    assert left.steering_angle == -right.steering_angle != 0.0
