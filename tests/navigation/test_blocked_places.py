"""Places that proved impassable."""

import math

import pytest
from maps import SCALE

from rover_common.geometry import Pose
from rover_navigation.blocked_places import STOPS, STUCK_SECONDS, BlockedPlaces

HERE = Pose(10.0, 10.0, math.pi / 2)


def test_where_the_robot_got_stuck_the_place_ahead_is_blocked_for_a_while():
    blocked = BlockedPlaces(SCALE)
    blocked.stuck(5.0, HERE)
    (place,) = blocked.places
    assert (place.x, place.y) == (
        pytest.approx(HERE.x),
        pytest.approx(HERE.y + SCALE.blocked_ahead),
    )
    blocked.update(5.0 + STUCK_SECONDS - 0.1)
    assert blocked.places == (place,)
    blocked.update(5.0 + STUCK_SECONDS)
    assert blocked.places == ()


def test_repeated_stops_on_one_spot_block_the_place_ahead():
    blocked = BlockedPlaces(SCALE)
    for stop in range(STOPS):
        assert blocked.places == ()
        blocked.stopped(1.0 + stop, HERE)
    assert len(blocked.places) == 1


@pytest.mark.parametrize(("apart", "seconds"), [(3.0, 1.0), (0.0, 30.0)])
def test_stops_far_apart_in_place_or_time_block_nothing(apart, seconds):
    blocked = BlockedPlaces(SCALE)
    for stop in range(STOPS):
        blocked.stopped(1.0 + seconds * stop, Pose(10.0 + apart * stop, 10.0, 0.0))
    assert blocked.places == ()


def test_unblock_keeps_what_is_blocked_for_good():
    blocked = BlockedPlaces(SCALE)
    blocked.block(HERE, 1.0, 0.5)
    assert not blocked.unblock()
    blocked.stuck(1.0, HERE)
    assert blocked.unblock()
    (place,) = blocked.places
    assert place.until == math.inf
