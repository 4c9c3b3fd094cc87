"""Coverage: from how near each cell was observed."""

import math

import numpy as np
import pytest
from maps import HALL, HERE, SCALE, costmap
from scans import open_scan

from rover_common.geometry import Pose
from rover_navigation.coverage import PERIOD, CoverageGrid, unsearched_cells


def distance(grid: CoverageGrid, x: float, y: float) -> float:
    coverage = grid.snapshot()
    return float(coverage.distance[coverage.geometry.cell_of(x, y)])


def test_cells_in_view_are_observed_from_where_the_robot_stands():
    grid = CoverageGrid(SCALE)
    grid.update(1.0, HERE, open_scan())
    assert distance(grid, 24.5, 20.5) == pytest.approx(math.hypot(4.5, 0.5))
    assert distance(grid, 20.5 + SCALE.search_range + 1.0, 20.5) == math.inf  # too far
    assert distance(grid, 16.5, 20.5) == math.inf  # behind


def test_obstacles_hide_what_is_behind_them():
    grid = CoverageGrid(SCALE)
    grid.update(1.0, HERE, open_scan(3.0))
    assert math.isfinite(distance(grid, 22.5, 20.5))
    assert distance(grid, 24.5, 20.5) == math.inf


def test_the_nearest_observation_counts():
    grid = CoverageGrid(SCALE)
    for step, x in enumerate((20.0, 22.0, 20.0)):
        grid.update(1.0 + step, Pose(x, 20.5, 0.0), open_scan())
    assert distance(grid, 24.5, 20.5) == pytest.approx(2.5)


def test_frames_that_follow_too_soon_are_left_out():
    grid = CoverageGrid(SCALE)
    grid.update(1.0, HERE, open_scan(1.0))
    grid.update(1.0 + 0.5 * PERIOD, HERE, open_scan())
    assert distance(grid, 24.5, 20.5) == math.inf


def test_a_snapshot_stays_as_it_is():
    grid = CoverageGrid(SCALE)
    before = grid.snapshot()
    grid.update(1.0, HERE, open_scan())
    assert np.isinf(before.distance).all()


def test_beyond_the_world_nothing_is_observed():
    grid = CoverageGrid(SCALE)
    grid.update(1.0, Pose(0.5, 0.5, math.pi), open_scan())
    observed = np.argwhere(np.isfinite(grid.snapshot().distance))
    assert len(observed)
    assert observed.max() <= SCALE.search_range


def test_unsearched_cells_are_ground_and_the_bases_of_walls():
    x, y, observed_from = unsearched_cells(
        CoverageGrid(SCALE).snapshot(), costmap(HALL), SCALE.base_reach
    )
    assert np.isinf(observed_from).all()
    cells = set(zip(x.tolist(), y.tolist(), strict=True))
    assert {(20.5, 20.5), (40.5, 20.5)} <= cells  # ground, and half a metre into the east wall
    assert (41.5, 20.5) not in cells
