"""Travel times between places do not depend on how far the search goes for them."""

import numpy as np
from changing_maps import requests
from hypothesis import given, settings
from hypothesis import strategies as st
from maps import SCALE, costmap, grid
from scipy import ndimage

import rover_navigation.local_searches as module
from rover_common.types import GridMap
from rover_navigation.plan_layers import PlanLayers
from rover_navigation.region import NearestCells, Region
from rover_navigation.roadmap import Roadmap

LANES = grid((5, 5, 55, 9), (5, 5, 9, 55), (51, 5, 55, 55), (5, 28, 55, 32))
ROADMAP = Roadmap(costmap(LANES), SCALE)
NODES = st.sampled_from(np.flatnonzero(np.isfinite(ROADMAP.seconds_from([0])[0])).tolist())


@settings(max_examples=50, deadline=None)
@given(NODES, st.lists(NODES, min_size=1, max_size=9))
def test_the_times_between_nodes_are_those_of_whole_searches(here, nodes):
    between = ROADMAP.seconds_between(ROADMAP.shortest_paths([here]), nodes)
    assert np.allclose(between, ROADMAP.seconds_from(nodes)[:, nodes])
    assert np.isfinite(between).all()


def test_a_search_between_near_nodes_goes_no_farther_than_they_are(monkeypatch):
    reached = []

    def counted(*arguments, **options):
        seconds = dijkstra(*arguments, **options)
        reached.append(np.isfinite(seconds).sum())
        return seconds

    dijkstra = module.dijkstra
    monkeypatch.setattr(module, "dijkstra", counted)
    near = np.argsort(np.hypot(ROADMAP.x - 7.0, ROADMAP.y - 7.0))[:20:4].tolist()
    Roadmap(costmap(LANES), SCALE).seconds_between(ROADMAP.shortest_paths([near[0]]), near)
    assert len(reached) == len(near)
    assert max(reached) < len(ROADMAP) / 5


def test_searches_are_kept_where_nothing_changes_and_made_anew_where_it_does(monkeypatch):
    searched = []

    def counted(*arguments, **options):
        searched.append(options["indices"])
        return dijkstra(*arguments, **options)

    dijkstra = module.dijkstra
    monkeypatch.setattr(module, "dijkstra", counted)
    layers, made, asked = PlanLayers(SCALE), 0, 0
    for made_request in requests(seed=21, count=60):
        layers.update(made_request)
        roadmap = layers.roadmap
        if len(roadmap) == 0:
            continue
        paths = roadmap.shortest_paths([len(roadmap) // 2])
        nodes = np.flatnonzero(np.isfinite(paths.seconds[0]))[:: max(1, len(roadmap) // 6)].tolist()
        nodes = nodes[:9]
        searched.clear()
        between = roadmap.seconds_between(paths, nodes)
        assert np.allclose(between, roadmap.seconds_from(nodes)[:, nodes])
        again = len(searched)
        assert np.array_equal(roadmap.seconds_between(paths, nodes), between)
        assert len(searched) == again  # nothing is searched twice
        made, asked = made + again, asked + len(nodes)
    assert 0 < made <= asked


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 1000), st.integers(1, 9))
def test_the_nearest_cells_of_a_changing_mask_are_those_of_the_mask(seed, reach):
    random = np.random.default_rng(seed)
    mask, nearest = random.random((40, 30)) < 0.03, NearestCells(reach)
    for _ in range(6):
        row, col = random.integers(0, 40), random.integers(0, 30)
        mask = mask.copy()
        mask[row : row + 4, col : col + 4] = random.random() < 0.5
        if not mask.any():
            continue
        rows, cols = nearest.of(mask)
        away = np.hypot(rows - np.arange(40)[:, None], cols - np.arange(30))
        away[~mask[rows, cols]] = np.inf
        true = ndimage.distance_transform_edt(~mask)
        near = true <= reach
        assert np.allclose(away[near], true[near])
        assert (away[~near] > reach).all()


def test_of_one_node_the_time_to_itself_is_none():
    cells = np.full((7, 13), -1, np.int8)
    cells[:4, :4] = cells[4:, 4:8] = 51
    cells[:4, 8:12] = cells[4:, 12] = 0
    alone = Roadmap(costmap(GridMap(0.25, 0.0, 0.0, cells), body=(0.0, 0.0)), SCALE)
    assert len(alone) == 1
    assert alone.seconds_between(alone.shortest_paths([0]), [0, 0]).tolist() == [[0, 0], [0, 0]]


def test_a_place_of_which_no_member_is_in_reach_has_no_node():
    cells = np.full((3, 18), -1, np.int8)
    cells[:, :4] = cells[:, 16:] = 0
    apart = Roadmap(costmap(GridMap(1.0, -14.0, -1.0, cells), body=(0.0, 0.0)), SCALE)
    members = np.array([False, False, True])
    region = Region(apart, members, SCALE.wide_reach, (NearestCells(2), NearestCells(2)))
    assert region.nodes_near(apart.x, apart.y, 1.0).tolist() == [-1, -1, 2]
