"""What is computed anew only where the map changed is what a whole computation gives."""

import numpy as np
import pytest
from changing_maps import SIDE, requests
from maps import HALL, SCALE, request
from numpy.testing import assert_array_equal

import rover_navigation.layered_costmap as module
from rover_common.vehicle import ROVER
from rover_navigation.costmap import Costmap
from rover_navigation.frontiers import Borders, find_frontiers
from rover_navigation.plan_layers import PlanLayers
from rover_navigation.planner import Planner
from rover_navigation.roadmap import Roadmap
from rover_navigation.selection import NearestStop, WholeTour
from rover_navigation.types import Plan, PlanRequest


def whole_costmap(made: PlanRequest) -> Costmap:
    return Costmap.of(made.grid, made.trail, (made.pose.x, made.pose.y), SCALE, made.blocked)


@pytest.mark.parametrize(("seed", "rows", "cols"), [(1, SIDE, SIDE), (2, 97, 131), (3, 60, SIDE)])
def test_layers_of_a_changing_map_are_those_of_the_whole_map(seed, rows, cols):
    layers = PlanLayers(SCALE)
    for made in requests(seed, 25, rows, cols):
        layers.update(made)
        whole = whole_costmap(made)
        assert layers.costmap.geometry == whole.geometry
        for name in ("free", "unknown", "edge"):
            assert_array_equal(getattr(layers.costmap, name), getattr(whole, name))
        for name in ("clearance", "edge_clearance"):
            limited = np.minimum(getattr(whole, name), np.float32(SCALE.clearance_limit))
            assert_array_equal(getattr(layers.costmap, name), limited)


@pytest.mark.parametrize("seed", range(4, 8))
def test_frontiers_and_roadmap_of_a_changing_map_are_those_of_the_whole_map(seed):
    layers = PlanLayers(SCALE)
    for made in requests(seed, 25):
        layers.update(made)
        whole = whole_costmap(made)
        for layer, expected in zip(layers.borders, Borders.of(whole), strict=True):
            assert_array_equal(layer, expected)
        found = find_frontiers(layers.costmap, made.blacklisted, SCALE, layers.borders)
        expected = find_frontiers(whole, made.blacklisted, SCALE)
        assert [frontier.x.tolist() for frontier in found] == [f.x.tolist() for f in expected]
        roadmap = Roadmap(whole, SCALE)
        assert_array_equal(layers.roadmap.x, roadmap.x)
        assert_array_equal(layers.roadmap.y, roadmap.y)
        if len(roadmap):
            start = [len(roadmap) // 2]
            paths = layers.roadmap.shortest_paths(start)
            assert_array_equal(paths.seconds, roadmap.shortest_paths(start).seconds)


def same(one: Plan, other: Plan) -> bool:
    """Whether two plans lead the same way."""
    paths = ((one.path, other.path), (one.home_path, other.home_path))
    return (one.goal, one.explored, one.placed) == (other.goal, other.explored, other.placed) and (
        all(np.array_equal(a.points, b.points) for a, b in paths)
        and all(np.array_equal(a.speeds, b.speeds) for a, b in paths)
        and np.array_equal(one.frontiers, other.frontiers)
    )


@pytest.mark.parametrize("selection", [WholeTour, NearestStop])
@pytest.mark.parametrize("seed", range(8, 14))
def test_a_plan_does_not_depend_on_the_plans_before(selection, seed):
    planner, goals = Planner(SCALE, selection(SCALE)), 0
    for made in requests(seed, 30):
        plan = planner.plan(made)
        goals += plan.goal is not None
        assert same(plan, Planner(SCALE, selection(SCALE)).plan(made))
    assert goals > 10


def test_another_map_or_trail_begins_anew():
    planner = Planner(SCALE, WholeTour(SCALE))
    for made in (*requests(14, 5), request(HALL), *requests(15, 5), *requests(16, 5, 60, 90)):
        assert same(planner.plan(made), Planner(SCALE, WholeTour(SCALE)).plan(made))


def test_a_plan_that_fails_leaves_nothing_behind(monkeypatch):
    first, *failing, last = requests(17, 20)
    planner = Planner(SCALE, WholeTour(SCALE))
    planner.plan(first)
    with monkeypatch.context() as patch:
        patch.setattr(module, "walls_of", None)
        for made in failing:
            with pytest.raises(TypeError):
                planner.plan(made)
    assert same(planner.plan(last), Planner(SCALE, WholeTour(SCALE)).plan(last))


def test_beyond_the_limit_clearance_makes_no_path_faster():
    assert SCALE.path_speed_per_clearance * SCALE.clearance_limit >= ROVER.max_speed
    assert SCALE.clearance_limit >= SCALE.inflation
    assert SCALE.clearance_limit - SCALE.path_clearance >= SCALE.smoothing_max
    assert SCALE.clearance_limit >= max(SCALE.padding, SCALE.shortcut_clearance)
