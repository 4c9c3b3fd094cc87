"""Breadcrumbs, and the path home over them."""

import math

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st
from maps import HALL, SCALE, UNKNOWN, costmap, grid
from scipy.sparse.csgraph import dijkstra

import rover_navigation.breadcrumb_path as module
from rover_common.geometry import Pose
from rover_navigation.breadcrumb_path import breadcrumb_path
from rover_navigation.breadcrumbs import Breadcrumbs
from rover_navigation.path_smoothing import smooth_path
from rover_navigation.types import BlockedPlace


def length(points: np.ndarray) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def test_breadcrumbs_lie_apart_and_begin_at_the_start():
    breadcrumbs = Breadcrumbs(0.5)
    assert breadcrumbs.points.shape == (0, 2)
    for x in np.arange(0.0, 3.05, 0.1):
        breadcrumbs.drop(Pose(float(x), 1.0, 0.0))
    assert np.allclose(breadcrumbs.points[0], (0.0, 1.0))
    assert (np.hypot(*np.diff(breadcrumbs.points, axis=0).T) >= 0.5).all()
    assert 5 <= len(breadcrumbs.points) <= 7


def test_loops_are_cut_out():
    breadcrumbs = Breadcrumbs(SCALE.breadcrumb_spacing)
    for angle in np.linspace(0, 2 * math.pi, 60):  # a loop that comes back near its beginning
        breadcrumbs.drop(Pose(20 + 5 * math.sin(angle), 20 - 5 * math.cos(angle), 0))
    trail = breadcrumbs.points
    path = breadcrumb_path(trail, trail[-1], costmap(HALL, trail, body=(20, 15)), SCALE)
    assert len(path) < 6
    assert np.hypot(*(path[-1] - trail[0])) < 0.1


def test_shortcuts_do_not_cut_through_walls():
    around = grid((10, 10, 40, 14), (36, 10, 40, 30), (10, 26, 40, 30))
    trail = np.array([(x, 12.0) for x in np.arange(12, 38)] + [(38.0, y) for y in range(12, 28)])
    trail = np.concatenate([trail, [(x, 28.0) for x in np.arange(38, 12, -1.0)]])
    here = (13.0, 28.0)
    path = breadcrumb_path(trail, here, costmap(around, trail, body=here), SCALE)
    assert length(path) > 55
    assert path[:, 0].max() > 35


def test_the_path_leads_around_a_place_where_the_robot_got_stuck():
    loop = [(20.0, y) for y in np.arange(16, 25)] + [(x, 24.0) for x in np.arange(21, 31)]
    loop += [(30.0, y) for y in np.arange(23, 16, -1.0)]
    loop += [(x, 17.0) for x in np.arange(29, 20, -1)]
    trail, here = np.array(loop, float), (28.0, 17.0)
    free = breadcrumb_path(trail, here, costmap(HALL, trail, body=here), SCALE)
    assert free[:, 1].max() < 18.0
    stuck = costmap(HALL, trail, body=here, blocked=(BlockedPlace(24.0, 17.0, 1.0),))
    around = breadcrumb_path(trail, here, stuck, SCALE)
    assert np.hypot(*(around - (24.0, 17.0)).T).min() > 1.0
    assert np.hypot(*(around[-1] - trail[0])) < 0.1


def test_the_graph_grows_with_the_ground_and_not_with_the_time(monkeypatch):
    """A robot that wiggles in one place for half an hour before it goes on."""
    sizes = []

    def counted(graph, *arguments, **options):
        sizes.append((graph.shape[0], graph.nnz))
        return dijkstra(graph, *arguments, **options)

    monkeypatch.setattr(module, "dijkstra", counted)
    wiggle = [(20.0 + 0.6 * (i % 2), 20.0 + 0.003 * (i % 100)) for i in range(3000)]
    before = [(x, 20.0) for x in np.arange(15.0, 20.0, 0.6)]
    after = [(x, 20.0) for x in np.arange(20.6, 30.0, 0.6)]
    trail, here = np.array(before + wiggle + after), (29.6, 20.0)
    path = breadcrumb_path(trail, here, costmap(UNKNOWN, trail, body=here), SCALE)
    once = np.array(before + after)
    assert sizes[0][0] < len(once) + 20
    assert sizes[0][1] < 2000
    assert length(path) < 1.1 * length(once)
    assert np.allclose(path[-1], trail[0])


def test_a_robot_that_comes_back_along_its_trail_goes_on_from_where_it_left_it():
    """Up and down a lane again and again, then into a side lane: no line through the wall."""
    lane = [(float(x), 20.0) for x in np.arange(12.0, 40.0, 0.6)]
    side = [(12.0, y) for y in np.arange(20.6, 35.0, 0.6)]
    trail, here = np.array((lane + lane[::-1]) * 5 + side), (12.0, 34.9)
    path = breadcrumb_path(trail, here, costmap(UNKNOWN, trail, body=here), SCALE)
    assert np.hypot(*np.diff(path, axis=0).T).max() < 1.0
    assert all(np.hypot(*(trail - point).T).min() < 0.5 for point in path)


def test_a_trail_of_less_than_two_points_is_its_own_path():
    for count in (0, 1):
        trail = np.full((count, 2), 20.0)
        path = breadcrumb_path(trail, (21.0, 20.0), costmap(HALL, trail), SCALE)
        assert np.array_equal(path, trail)


METRES = st.floats(-80.0, 140.0)  # the map ends at 0 and 60 m
STEPS = st.lists(st.tuples(st.floats(-9.0, 9.0), st.floats(-9.0, 9.0)), min_size=1, max_size=40)


@settings(max_examples=150, deadline=None)
@example(1.25, 0.0, [(0.0, 0.0)] * 4 + [(-0.25, 0.0)], (0.0, 0.0), HALL)
@given(METRES, METRES, STEPS, st.tuples(METRES, METRES), st.sampled_from([HALL, UNKNOWN]))
def test_a_trail_may_leave_the_costmap(x, y, steps, position, map_):
    trail = np.array([(x, y)]) + np.cumsum(np.array([(0.0, 0.0), *steps]), axis=0)
    made = costmap(map_, trail, body=position)
    raw = breadcrumb_path(trail, position, made, SCALE)
    nearest = trail[np.argmin(np.hypot(*(trail - position).T))]
    place = math.sqrt(2.0) * SCALE.breadcrumb_spacing  # a breadcrumb stands for others within it
    assert math.dist(raw[0], position) <= math.dist(nearest, position) + place
    assert np.allclose(raw[-1], trail[0])
    driven = np.hypot(*np.diff(trail, axis=0).T)
    assert np.hypot(*np.diff(raw, axis=0).T).max() <= 1.0 + max(0.5, driven.max())
    path = smooth_path(raw, made, SCALE)
    assert np.isfinite(path.points).all()
    assert np.allclose(path.points[[0, -1]], raw[[0, -1]])
    inside = made.geometry.contains(*made.geometry.cell_of(*path.points.T))
    assert (path.speeds[~inside] == SCALE.path_speed_min).all()


def test_obstacles_count_on_their_own_side_of_the_map_only():
    """A trail beyond the map's south border, beside a wall at its north border."""
    walled = grid((1, 1, 59, 50))
    trail = np.array([(x, -8.0) for x in np.arange(10.0, 30.0, 0.5)])
    made = costmap(walled, trail, body=(29.0, 2.0))
    path = breadcrumb_path(trail, (29.5, -8.0), made, SCALE)
    assert np.allclose(path[:, 1], -8.0)


def test_a_robot_that_circles_in_a_wide_place_makes_no_large_graph(monkeypatch):
    """Every place within 6 m, driven through again and again: all of them could be linked."""
    sizes = []

    def counted(graph, *arguments, **options):
        sizes.append(graph.nnz)
        return dijkstra(graph, *arguments, **options)

    monkeypatch.setattr(module, "dijkstra", counted)
    turns = np.linspace(0.0, 2 * math.pi * 90, 9000)
    radius = 5.5 * np.abs(np.sin(turns / 7.3))
    trail = np.stack([30.0 + radius * np.cos(turns), 20.0 + radius * np.sin(turns)], axis=1)
    lead = np.stack([np.arange(12.0, 30.0, 0.5), np.full(36, 20.0)], axis=1)
    trail = np.concatenate([lead, trail])
    here = tuple(trail[-1])
    path = breadcrumb_path(trail, here, costmap(HALL, trail, body=here), SCALE)
    assert sizes[0] < 60_000
    assert length(path) < 1.1 * math.dist(here, trail[0])
