"""The planner: which goal, and the path there, from maps drawn by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from maps import HALL, HERE, OPEN_EAST, SCALE, UNKNOWN, grid, opened, plan

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.map_encoding import EDGE
from rover_common.types import GridMap
from rover_navigation.coverage import CoverageGrid
from rover_navigation.selection import NearestStop, WholeTour
from rover_navigation.types import BlockedPlace, Coverage, GoalKind, Target


def target(x: float, y: float, number: int = 1) -> Target:
    return Target(number, x, y, SCALE.target_reach)


def test_a_closed_map_leaves_no_goal():
    made = plan(HALL)
    assert made.goal is None
    assert made.explored == 1.0
    assert np.hypot(*(made.home_path.points[-1] - (12.0, 20.0))) < 0.5


def test_an_opening_into_the_unknown_is_the_goal():
    made = plan(OPEN_EAST)
    assert made.goal is not None
    assert made.goal.kind is GoalKind.FRONTIER
    assert made.goal.x == pytest.approx(40, abs=0.5)
    assert len(made.frontiers) == 1
    assert np.all(np.diff(made.path.points[:, 0]) >= 0)  # straight to it
    assert made.explored < 1.0


def test_a_frontier_too_short_to_drive_through_is_no_goal():
    assert plan(opened(HALL, 40, 19.25, 41, 20.75)).goal is None
    assert plan(opened(HALL, 40, 18.5, 41, 21.5)).goal is not None


def test_blacklisted_places_are_no_goals():
    made = plan(OPEN_EAST, blacklisted=np.array([[39.9, y, 1.5] for y in np.arange(16, 25)]))
    assert made.goal is None


def test_a_retryable_goal_is_worth_only_a_short_detour():
    before = np.array([[40.0, 20.0, 2.0]])
    near, far = Pose(36.0, 20.0, 0.0), Pose(14.0, 20.0, 0.0)
    for pose, tried in ((near, True), (far, False)):
        home = (pose.x, pose.y)
        made = plan(OPEN_EAST, retryable=before, pose=pose, home=home)
        assert (made.goal is not None) is tried
        assert plan(OPEN_EAST, pose=pose, home=home).goal is not None


def test_many_small_unknown_patches_do_not_displace_a_large_one():
    patches = HALL
    for x in np.arange(13.0, 26.0, 3.0):  # each takes more time to stop at than it is worth
        patches = opened(patches, x, 16, x + 1.0, 17)
    assert plan(patches).goal is None
    large = plan(opened(patches, 30, 18, 36, 22))
    assert large.goal is not None
    assert large.goal.x > 29.0


def with_edge(x0: float, x1: float) -> GridMap:
    """The hall with a piece of its south wall seen from afar only."""
    return opened(HALL, x0, 14, x1, 15, EDGE)


def test_a_wall_seen_from_afar_is_observed_where_that_costs_little():
    on_the_path = plan(with_edge(14, 22), pose=Pose(36.0, 17.0, math.pi), home=(12.0, 17.0))
    assert on_the_path.goal is not None
    assert on_the_path.goal.y == pytest.approx(15, abs=0.5)
    west = Pose(12.0, 20.0, 0.0)
    off_the_path = plan(with_edge(34, 38), pose=west)
    assert off_the_path.goal is None
    assert len(off_the_path.frontiers) == 1  # it is still shown
    as_wide_an_opening = opened(HALL, 34, 14, 38, 15)
    assert plan(as_wide_an_opening, pose=west).goal is not None


def test_paths_lead_around_blocked_places():
    path = plan(OPEN_EAST, blocked=(BlockedPlace(30.0, 20.0, 2.0),)).path.points
    assert np.hypot(path[:, 0] - 30, path[:, 1] - 20).min() > 2.0


def test_ground_behind_a_narrow_gap_is_observed_from_before_the_gap():
    narrow = grid((10, 15, 30, 25), (30, 19.75, 34, 20.25), (34, 15, 37, 25))
    made = plan(opened(narrow, 37, 16, 38, 24))
    assert made.goal is not None
    assert made.path.points[-1, 0] < 31.0


def test_a_target_on_the_path_comes_first_and_one_off_the_path_later():
    near = plan(OPEN_EAST, targets=(target(28.0, 20.0, 3),))
    assert (near.goal.kind, near.goal.target_id) == (GoalKind.TARGET, 3)
    behind = plan(OPEN_EAST, targets=(target(12.0, 20.0, 4),))  # at home: on the way back
    assert behind.goal.kind is GoalKind.FRONTIER
    assert plan(HALL, targets=(target(50.0, 50.0),)).goal is None  # out of reach


def test_the_nearest_stop_and_the_whole_tour_choose_differently():
    """A short arm to the west, where home is, and a long one to the east."""
    two = opened(opened(HALL, 40, 16, 41, 24), 9, 16, 10, 24)
    at = Pose(23.0, 20.0, math.pi)
    assert plan(two, NearestStop, pose=at).goal.x < 15
    assert plan(two, WholeTour, pose=at, home=(10.5, 20.0)).goal.x > 35


def test_unsearched_cells_are_the_goal_while_targets_are_missing():
    coverage = CoverageGrid(SCALE).snapshot()
    assert plan(HALL, search=True, coverage=coverage).goal.kind is GoalKind.SEARCH
    assert plan(HALL, search=False, coverage=coverage).goal is None


def test_the_base_of_a_wall_is_searched_like_the_ground_before_it():
    geometry = GridGeometry.of_world(1.0)
    observed = np.full((geometry.rows, geometry.cols), 2.0, np.float32)
    assert plan(HALL, search=True, coverage=Coverage(geometry, observed)).goal is None
    observed[20, 40] = 8.0  # half a metre into the east wall
    made = plan(HALL, search=True, coverage=Coverage(geometry, observed))
    assert (made.goal.x, made.goal.y) == (40.5, 20.5)
    assert np.hypot(*(made.path.points[-1] - (40.5, 20.5))) < 2.0
    observed[20, 40], observed[20, 41] = 2.0, 8.0  # deeper than a base reaches
    assert plan(HALL, search=True, coverage=Coverage(geometry, observed)).goal is None


def test_on_an_unknown_map_the_goal_is_where_the_robot_stands():
    made = plan(UNKNOWN)
    assert made.goal is not None
    assert np.hypot(made.goal.x - HERE.x, made.goal.y - HERE.y) < 2.0
    assert len(made.home_path) == 0


def test_a_robot_inside_of_an_obstacle_has_no_place_on_the_map():
    made = plan(HALL, pose=Pose(50.0, 50.0, 0.0))
    assert made.placed
    walled_in = opened(HALL, 44, 44, 56, 56, 100)
    made = plan(walled_in, pose=Pose(50.0, 50.0, 0.0))
    assert not made.placed
    assert made.goal is None
    assert len(made.path) == len(made.home_path) == 0


def test_home_by_breadcrumbs_leads_back_along_the_trail():
    detour = [(12.0, y) for y in np.arange(20.0, 24.0, 0.5)]
    detour += [(x, 23.5) for x in np.arange(12.0, 30.0, 0.5)]
    trail = np.array(detour)
    at = {"pose": Pose(29.5, 23.5, 0.0), "trail": trail}
    along = plan(HALL, **at, home_by_breadcrumbs=True).home_path.points
    assert np.allclose(along[-1], trail[0], atol=0.5)
    assert np.allclose(plan(HALL, **at).home_path.points[-1], (12.0, 20.0), atol=0.5)
    unknown = plan(UNKNOWN, **at, home_by_breadcrumbs=True).home_path.points
    assert np.allclose(unknown[-1], trail[0], atol=0.5)  # the map shows no path at all
