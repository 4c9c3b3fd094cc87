"""Classic B: where it steers, on made frames."""

from __future__ import annotations

import math

import numpy as np
import pytest
from classic_frames import (
    ground,
    patch,
)

from rover_common.vehicle import ROVER
from rover_decision.missions.sample_return.classic import rules_b as rules

HARD = ROVER.max_steering
TEN_DEGREES = math.radians(10.0)


def view(floor) -> rules.View:
    return rules.View.of(ground(floor))


def strip(left: float, right: float):
    """Floor up to so far [m] to either side."""
    return lambda x, y: (y < left) & (y > -right)


def few(x, y):
    """Fewer cells than it stops at."""
    return patch(2.0, 0.0, rules.STOP_FORWARD - 1)(x, y)


def some(x, y):
    """Fewer cells than it goes on with."""
    return patch(2.0, 0.0, rules.GO_FORWARD - 1)(x, y)


class TestSteering:
    def test_the_mean_bearing_and_ten_degrees_to_the_left(self):
        aside = view(lambda x, y: (y < 1.5) & (y > -1.2))
        command = rules.careful_drive(aside, 1.0, rules.EXPLORING)
        assert command.steering_angle == pytest.approx(aside.near.bearings.mean() + TEN_DEGREES)

    def test_only_ground_within_five_metres_has_a_bearing(self):
        far = view(lambda x, y: (x > 5.0) & (y > 0) | (np.abs(y) < 1.0))
        assert far.mean_bearing() == pytest.approx(0.0, abs=0.01)
        assert far.ground.ranges.max() > 5.0 > far.near.ranges.max()

    def test_a_side_without_room_is_turned_away_from_hard(self):
        left = rules.careful_drive(view(strip(0.0, 3.0)), 1.0, rules.EXPLORING)
        assert (left.throttle, left.brake, left.steering_angle) == (0.0, 0.0, -HARD)
        right = rules.careful_drive(view(strip(3.0, 0.0)), 1.0, rules.EXPLORING)
        assert right.steering_angle == HARD

    def test_a_side_with_much_more_room_is_turned_to_gently(self):
        wide = view(strip(0.9, 2.0))
        left, right = wide.ground.sides(rules.STRIP)
        assert right > rules.LEFT_RIGHT_RATIO * left > rules.STOP_SIDE
        bearing = rules.to_wide_side(wide)
        bearings = wide.near.bearings
        assert bearing == pytest.approx(bearings[bearings < 0].mean())
        command = rules.careful_drive(wide, 1.0, rules.EXPLORING)
        assert (command.throttle, command.steering_angle) == (0.2, max(-HARD, bearing))
        assert rules.to_wide_side(view(strip(2.0, 0.9))) > 0
        assert rules.to_wide_side(view(strip(2.0, 1.8))) is None

    def test_the_strip_is_two_metres_to_either_side(self):
        assert ground(strip(9.0, 9.0)).sides(2.0) == ground(strip(2.0, 2.0)).sides(2.0)

    @pytest.mark.parametrize(
        ("manner", "bias", "top", "throttle"),
        [
            (rules.EXPLORING, TEN_DEGREES, 1.5, 0.2),
            (rules.OUT_OF_CIRCLE, 0.0, 1.5, 0.2),
            (rules.HOMEWARD, 0.0, 1.5, 0.2),
            (rules.DRIVE_OUT, 0.0, 2.0, 1.0),
        ],
    )
    def test_bias_and_pace_are_set_by_the_state(self, manner, bias, top, throttle):
        even = view(strip(1.5, 1.5))
        slow = rules.careful_drive(even, top - 0.1, manner)
        assert slow.throttle == throttle
        assert slow.steering_angle == pytest.approx(even.mean_bearing() + bias)
        assert rules.careful_drive(even, top + 0.1, manner).throttle == 0.0
