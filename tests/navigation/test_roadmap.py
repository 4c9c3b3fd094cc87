"""Travel times between places do not depend on how far the search goes for them."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from maps import SCALE, costmap, grid

import rover_navigation.roadmap as module
from rover_navigation.roadmap import Roadmap

LANES = grid((5, 5, 55, 9), (5, 5, 9, 55), (51, 5, 55, 55), (5, 28, 55, 32))
ROADMAP = Roadmap(costmap(LANES), SCALE)
NODES = st.sampled_from(np.flatnonzero(np.isfinite(ROADMAP.seconds_from([0])[0])).tolist())


@settings(max_examples=50, deadline=None)
@given(NODES, st.lists(NODES, min_size=1, max_size=9))
def test_the_times_between_nodes_are_those_of_whole_searches(here, nodes):
    from_here = ROADMAP.shortest_paths([here]).seconds[0, nodes]
    between = ROADMAP.seconds_between(nodes, from_here)
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
    from_here = ROADMAP.seconds_from([near[0]])[0, near]
    reached.clear()
    ROADMAP.seconds_between(near, from_here)
    assert max(reached) < len(ROADMAP) / 5
