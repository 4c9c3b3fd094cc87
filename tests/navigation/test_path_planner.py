"""Paths of the burger: gaps, hazards, starts in inflated cells, goals that are refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rover_common.geometry import Pose
from rover_common.types import GridMap
from rover_navigation.burger_scale import BURGER_SCALE
from rover_navigation.hazards import Hazards
from rover_navigation.path_planner import Ground

HERE, GOAL = Pose(0.5, 1.0, 0.0), Pose(2.5, 1.0, 0.0)


def hall(gap: float | None = None) -> GridMap:
    """3 x 2 m with walls of one cell; with a wall across that has a gap of so many metres."""
    cells = np.zeros((40, 60), np.int8)
    cells[[0, -1]] = 100
    cells[:, [0, -1]] = 100
    if gap is not None:
        half = round(gap / 0.05 / 2)
        cells[:, 30] = 100
        cells[20 - half : 20 + round(gap / 0.05) - half, 30] = 0
    return GridMap(0.05, 0.0, 0.0, cells)


def ground(grid: GridMap, hazards: Hazards | None = None, body: Pose = HERE) -> Ground:
    return Ground(grid, hazards or Hazards(), body, BURGER_SCALE)


def blocked(grid: GridMap, x0: float, y0: float, x1: float, y1: float) -> Hazards:
    """A rectangle [m] of a map, as a mission blocks it."""
    cells = grid.cells.copy()
    cells[round(y0 / 0.05) : round(y1 / 0.05), round(x0 / 0.05) : round(x1 / 0.05)] = 100
    hazards = Hazards()
    hazards.set(GridMap(0.05, 0.0, 0.0, cells), grid)
    return hazards


@pytest.mark.parametrize(("gap", "open_"), [(0.60, True), (0.45, True), (0.25, False)])
def test_a_gap_of_0_45_m_is_wide_enough_and_none_of_the_bodys_width(gap, open_):
    path = ground(hall(gap)).path(HERE, GOAL, 0.1)
    assert (len(path) > 0) is open_
    if open_:
        assert tuple(path[0]) == pytest.approx((0.5, 1.0), abs=0.02)
        assert tuple(path[-1]) == pytest.approx((2.5, 1.0), abs=0.02)
        assert np.hypot(*np.diff(path, axis=0).T).max() < 0.15


def test_a_path_keeps_off_walls_where_there_is_ground():
    costmap = ground(hall()).costmap
    path = ground(hall()).path(Pose(0.2, 0.2, 0.0), Pose(2.8, 0.2, 0.0), 0.1)
    row, col = costmap.geometry.cell_of(*path.T)
    middle = costmap.clearance[row, col][len(path) // 4 : -len(path) // 4]
    assert middle.min() > 0.2


def test_a_path_leads_around_a_blocked_place_and_not_through_it():
    hazards = blocked(hall(), 1.2, 0.05, 1.8, 1.4)
    path = ground(hall(), hazards).path(HERE, GOAL, 0.1)
    beside = path[(path[:, 0] > 1.15) & (path[:, 0] < 1.85)]
    assert len(beside) > 5
    assert beside[:, 1].min() > 1.5
    assert ground(hall(), hazards).refusal(Pose(1.5, 1.0, 0.0), 0.1) == "the goal is in a wall"


def test_blocked_places_stay_in_place_when_the_map_grows():
    hazards = blocked(hall(), 1.2, 0.05, 1.8, 1.4)
    grown = np.pad(hall().cells, 20, constant_values=-1)
    path = ground(GridMap(0.05, -1.0, -1.0, grown), hazards).path(HERE, GOAL, 0.1)
    assert path[np.abs(path[:, 0] - 1.5) < 0.3, 1].min() > 1.5


def test_walls_that_the_map_has_lost_since_are_no_blocked_places():
    hazards = Hazards()
    hazards.set(hall(0.25), hall(0.25))  # nothing blocked beside the walls
    assert len(ground(hall(), hazards).path(HERE, GOAL, 0.1)) > 0


def test_a_robot_on_a_blocked_place_gets_off_it():
    hazards = blocked(hall(), 0.4, 0.9, 0.7, 1.2)
    path = ground(hall(), hazards).path(HERE, GOAL, 0.1)
    assert len(path) > 0


def test_a_robot_in_inflated_cells_starts_on_its_own_side_of_a_thin_wall():
    cells = hall().cells.copy()
    cells[:, [5, 12]] = 100  # a lane from x = 0.30 to 0.60 m, too narrow to drive
    narrow = GridMap(0.05, 0.0, 0.0, cells)
    assert len(ground(narrow).path(HERE, GOAL, 0.1)) == 0
    near_wall = Pose(0.10, 1.0, 0.0)
    assert len(ground(hall(), body=near_wall).path(near_wall, GOAL, 0.1)) > 0


@pytest.mark.parametrize(
    ("goal", "tolerance", "reason"),
    [
        (Pose(math.inf, 0.0, 0.0), 0.1, "the goal is not a number"),
        (Pose(1.0, 1.0, math.nan), 0.1, "the goal is not a number"),
        (Pose(1.0, 1.0, 0.0), math.nan, "the goal is not a number"),
        (Pose(1.0, 1.0, 0.0), 0.0, "the tolerance is not positive"),
        (Pose(1.0, 9.0, 0.0), 0.1, "the goal is out of the map"),
        (Pose(2.98, 1.0, 0.0), 0.1, "the goal is in a wall"),
        (Pose(2.90, 1.0, 0.0), 0.05, "the goal is too near to a wall"),
        (Pose(2.90, 1.0, 0.0), 0.20, ""),
        (Pose(2.50, 1.0, 0.0), 0.05, ""),
    ],
)
def test_a_goal_is_refused_with_a_reason(goal, tolerance, reason):
    assert ground(hall()).refusal(goal, tolerance) == reason


def test_a_goal_in_unknown_cells_is_refused():
    cells = hall().cells.copy()
    cells[10:30, 40:55] = -1
    grid = GridMap(0.05, 0.0, 0.0, cells)
    assert ground(grid).refusal(Pose(2.4, 1.0, 0.0), 0.1) == "the goal is in unknown cells"
