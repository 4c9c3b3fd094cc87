"""Whether a saved state may go on: by time and by the robot's odometry."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rover_common.burger import BURGER
from rover_common.geometry import Pose
from rover_common.same_robot import MARGIN, OLDEST, check_goes_on, memory_of, odometry_of
from rover_common.saved_state import StateError
from rover_common.sensor_types import Twist, WheelOdometry

SECOND = 1_000_000_000
BEFORE = WheelOdometry(100 * SECOND, Pose(3.0, 4.0, 1.0), Twist(0.2, 0.1))


def later(seconds: float, moved: float) -> WheelOdometry:
    return WheelOdometry(
        BEFORE.stamp + round(seconds * SECOND), Pose(3.0 + moved, 4.0, 0.0), Twist()
    )


@given(st.floats(0.0, OLDEST - 1e-3), st.floats(0.0, 0.99))
def test_a_robot_that_can_have_driven_there_is_the_same_one(seconds, share):
    reach = BURGER.cruise_speed * seconds + MARGIN
    assert check_goes_on(BEFORE, later(seconds, share * reach)) == pytest.approx(seconds, abs=1e-6)


@pytest.mark.parametrize(
    ("seconds", "moved", "reason"),
    [
        (-1.0, 0.0, "newer"),
        (OLDEST + 1.0, 0.0, "old"),
        (1.0, 1.0, "begun anew"),
        (10.0, math.nan, "begun anew"),
        (4.0, -3.0, "begun anew"),
    ],
)
def test_one_that_cannot_is_another(seconds, moved, reason):
    with pytest.raises(StateError, match=reason):
        check_goes_on(BEFORE, later(seconds, moved))


def test_odometry_goes_through_a_memory_as_it_is():
    assert odometry_of(memory_of(BEFORE)) == BEFORE
