"""Corridors over the free ground of one scan."""

import math

import numpy as np
import pytest
from scans import RANGE, open_scan, scan_of

from rover_navigation.local_clearance import LocalClearance

CORRIDOR = 0.5  # [m] half width
MIDDLE = 54  # the index of the bearing straight ahead


def with_obstacle() -> LocalClearance:
    """Free for 6 m, but for an obstacle 3 m right ahead."""
    ranges = np.full(109, 6.0)
    ranges[50:58] = 3.0
    return LocalClearance.of(scan_of(ranges), CORRIDOR)


def test_a_corridor_is_as_long_as_its_nearest_obstacle():
    local = with_obstacle()
    assert local.clearance(0.0) == pytest.approx(3.0, abs=0.05)
    assert local.clearance(math.radians(40)) == pytest.approx(6.0, abs=0.2)


def test_an_obstacle_beside_the_bearing_narrows_its_corridor():
    ranges = np.full(109, 6.0)
    ranges[MIDDLE + 5] = 3.0  # 0.26 m to the left of straight ahead
    local = LocalClearance.of(scan_of(ranges), CORRIDOR)
    assert local.clearance(0.0) == pytest.approx(3.0, abs=0.05)
    assert LocalClearance.of(scan_of(ranges), 0.2).clearance(0.0) == pytest.approx(6.0, abs=0.05)


def test_the_best_bearing_is_the_free_one_nearest_to_the_wanted_one():
    local = with_obstacle()
    assert math.radians(5) < abs(local.best_bearing(0.0, 5.0)) < math.radians(25)
    assert local.best_bearing(0.6, 5.0) == pytest.approx(0.6, abs=math.radians(2))
    assert local.open_bearing(5.0) == local.best_bearing(0.0, 5.0)


def test_without_a_corridor_of_the_length_the_longest_one_is_best():
    ranges = np.full(109, 2.0)
    ranges[80:] = 4.0  # to the left
    local = LocalClearance.of(scan_of(ranges), CORRIDOR)
    assert local.best_bearing(0.0, 9.0) > math.radians(25)
    assert local.open_bearing(9.0) is None
    assert local.wider_side() == 1
    assert LocalClearance.of(scan_of(ranges[::-1]), CORRIDOR).wider_side() == -1


def test_a_scan_without_an_end_is_free_for_its_range():
    local = LocalClearance.of(open_scan(math.inf), CORRIDOR)
    assert local.clearance(0.0) == pytest.approx(RANGE, abs=0.05)


def test_a_scan_without_rays_shows_no_free_ground():
    local = LocalClearance.of(scan_of(np.empty(0)), CORRIDOR)
    assert local.clearance(0.0) == 0.0
    assert local.open_bearing(1.0) is None
