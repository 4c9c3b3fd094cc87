"""The vehicle's facts, against what was measured of it."""

import dataclasses
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rover_common.grid import WORLD
from rover_common.vehicle import ROVER

SPEEDS = st.floats(-10.0, 10.0)


def test_the_model_cannot_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        ROVER.max_speed = 6.0


@given(SPEEDS)
def test_the_wheels_turn_less_at_speed_and_alike_in_both_directions(speed):
    limit = ROVER.wheel_limit(speed)
    assert ROVER.wheel_at_max_speed <= limit <= ROVER.wheel_at_rest
    assert limit == ROVER.wheel_limit(-speed)
    assert limit >= ROVER.wheel_limit(speed * 1.1)


@pytest.mark.parametrize(("speed", "degrees"), [(0.0, 15.0), (2.5, 10.0), (5.0, 5.0), (9.0, 5.0)])
def test_the_wheel_limit_is_linear_in_the_speed(speed, degrees):
    assert math.degrees(ROVER.wheel_limit(speed)) == pytest.approx(degrees)


@pytest.mark.parametrize(
    ("speed", "degrees_per_second"), [(1.0, 17.0), (2.0, 29.0), (3.0, 36.0), (5.0, 33.0)]
)
def test_yaw_rates_at_full_steering_are_those_measured(speed, degrees_per_second):
    kinematic = speed * math.tan(ROVER.wheel_limit(speed)) / ROVER.wheelbase
    assert math.degrees(ROVER.yaw_factor * kinematic) == pytest.approx(degrees_per_second, abs=0.6)


def test_the_world_holds_its_start_and_not_its_far_edges():
    assert WORLD.contains(WORLD.start_x, WORLD.start_y)
    assert WORLD.contains(0.0, 0.0)
    assert not WORLD.contains(WORLD.size, 0.0)
    assert not WORLD.contains(0.0, -0.1)
