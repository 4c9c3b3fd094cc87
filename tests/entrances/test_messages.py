"""Every message is taken as what it is, or refused; none raises anything else."""

from __future__ import annotations

import math

import pytest
from cases import CASES, fuzzed
from hostile_messages import GOOD, changed
from hypothesis import given
from hypothesis import strategies as st
from nav_msgs.msg import OccupancyGrid, Odometry
from readers import read

from rover_common.ros.message_checks import CHECKS
from rover_common.ros.message_errors import RotationError

KINDS = sorted(CHECKS, key=lambda kind: kind.__name__)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_a_good_message_of_every_type_is_taken(kind):
    assert read(GOOD[kind])


@fuzzed(CASES * 0.3)
@given(st.sampled_from(KINDS).flatmap(changed))
def test_a_message_is_taken_with_finite_numbers_or_refused_with_a_reason(message):
    read(message)


@fuzzed(CASES * 0.05)
@given(st.integers(0, 6), st.integers(0, 6), st.integers(0, 40))
def test_a_map_that_does_not_hold_what_it_says_is_refused(width, height, cells):
    grid = OccupancyGrid(data=GOOD[OccupancyGrid].data[:cells])
    grid.info.width, grid.info.height, grid.info.resolution = width, height, 0.5
    assert read(grid) == (0 < width * height == cells)


@fuzzed(CASES * 0.05)
@given(*[st.floats(-2.0, 2.0)] * 4)
def test_a_quaternion_is_taken_as_the_rotation_that_it_is_or_refused(x, y, z, w):
    message = Odometry(header=GOOD[Odometry].header)
    q = message.pose.pose.orientation
    q.x, q.y, q.z, q.w = x, y, z, w
    length = math.hypot(x, y, z, w)
    assert read(message) == (abs(length**2 - 1.0) <= 0.01)
    if length > 0.1:
        q.x, q.y, q.z, q.w = x / length, y / length, z / length, w / length
        assert read(message)


def test_an_orientation_of_half_length_is_refused_by_that_name():
    message = Odometry(header=GOOD[Odometry].header)
    message.pose.pose.orientation.w = 0.5
    with pytest.raises(RotationError, match=r"length 0\.5"):
        CHECKS[Odometry](message)
