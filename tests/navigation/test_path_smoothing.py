"""Smoothing: corners rounded off as far as the clearance allows."""

import math

import numpy as np
import pytest
from maps import HALL, SCALE, costmap, grid

from rover_navigation.path_smoothing import smooth_path


def staircase(corner: float) -> np.ndarray:
    """East, then north: cells' centres around a right angle at (corner, 20) [m]."""
    east = [(x, 20.0) for x in np.arange(12.0, corner, 0.5)]
    return np.array(east + [(corner, y) for y in np.arange(20.0, 24.0, 0.5)])


def sharpest(points: np.ndarray) -> float:
    """The largest turn [rad] between two steps."""
    heading = np.unwrap(np.arctan2(*np.diff(points, axis=0).T[::-1]))
    return float(np.abs(np.diff(heading)).max())


def test_a_path_is_rounded_off_where_it_has_clearance_and_keeps_its_ends():
    raw = staircase(30.0)
    wide = smooth_path(raw, costmap(HALL), SCALE)
    narrow = smooth_path(raw, costmap(grid((10, 19, 30.75, 21), (29, 15, 31, 25))), SCALE)
    for path in (wide, narrow):
        assert np.allclose(path.points[[0, -1]], raw[[0, -1]])
    assert sharpest(raw) == pytest.approx(math.pi / 2)
    assert sharpest(wide.points) < math.radians(15)
    assert sharpest(wide.points) < sharpest(narrow.points) / 1.5
    assert wide.speeds.min() > narrow.speeds.min() >= SCALE.path_speed_min


@pytest.mark.parametrize("count", [0, 1, 2, 3, 4])
def test_a_path_may_be_short(count):
    raw = staircase(30.0)[:count].reshape(-1, 2)
    path = smooth_path(raw, costmap(HALL), SCALE)
    assert np.allclose(path.points, raw)
    assert len(path.speeds) == count


def test_outside_of_the_costmap_a_path_is_driven_at_the_lowest_speed():
    points = np.stack([np.arange(-20.0, 30.0, 0.5), np.full(100, 20.0)], axis=1)
    hall = costmap(HALL)
    path = smooth_path(points, hall, SCALE)
    outside = path.points[:, 0] < hall.geometry.origin_x
    assert outside.any()
    assert (path.speeds[outside] == SCALE.path_speed_min).all()
    assert path.speeds[-1] > SCALE.path_speed_min
