"""From fixes to sources."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from made_fixes import cloud, fix

from rover_heat.config import HeatConfig
from rover_heat.thermal.fix import Fix
from rover_heat.thermal.sources import find_sources

CONFIG = HeatConfig()
KMEANS = replace(CONFIG, clustering="kmeans", clusters=3)


def places(fixes: list[Fix], config: HeatConfig = CONFIG) -> list[tuple[float, float]]:
    return sorted((round(s.x, 1), round(s.y, 1)) for s in find_sources(fixes, config))


@pytest.mark.parametrize("config", [CONFIG, KMEANS], ids=["groups", "kmeans"])
def test_no_fixes_are_no_sources(config):
    assert find_sources([], config) == ()


@pytest.mark.parametrize("clusters", [0, 1, 2, 3, 5, 20])
@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_kmeans_never_has_more_clusters_than_fixes(clusters, count):
    fixes = [fix(0.9 * i, 0.0) for i in range(count)]
    found = find_sources(fixes, replace(KMEANS, clusters=clusters))
    assert 1 <= len(found) <= min(count, clusters or 3)
    same = [fix(1.0, 1.0)] * count
    assert len(find_sources(same, replace(KMEANS, clusters=clusters))) == 1


@given(
    st.lists(st.tuples(st.floats(-5, 5), st.floats(-5, 5), st.floats(-3, 3)), max_size=30),
    st.integers(0, 6),
    st.sampled_from(["groups", "kmeans"]),
)
def test_whatever_the_fixes_are_no_more_sources_come_than_are_wanted(rows, clusters, clustering):
    config = replace(CONFIG, clusters=clusters, clustering=clustering)
    found = find_sources([fix(*row) for row in rows], config)
    assert len(found) <= (clusters or (3 if clustering == "kmeans" else len(rows)))
    assert all(math.isfinite(source.x + source.y + sum(source.covariance)) for source in found)


def test_clouds_apart_are_sources_of_their_own():
    fixes = cloud(0.0, 0.0, 20) + cloud(1.0, 0.0, 10, seed=1) + cloud(0.0, 2.0, 5, seed=2)
    assert places(fixes) == [(0.0, 0.0), (0.0, 2.0), (1.0, 0.0)]
    assert [s.observations for s in find_sources(fixes, CONFIG)] == [20, 10, 5]


def test_both_sides_of_a_wall_are_sources_of_their_own():
    fixes = cloud(1.0, 1.0, 8, normal=1.5) + cloud(1.0, 1.0, 6, normal=-1.6)
    assert len(find_sources(fixes, CONFIG)) == 2
    turned = cloud(1.0, 1.0, 8, normal=1.5) + cloud(1.0, 1.0, 6, normal=1.2)
    assert len(find_sources(turned, CONFIG)) == 1


def test_a_group_of_too_few_is_no_source():
    assert find_sources(cloud(0.0, 0.0, 2), CONFIG) == ()
    assert len(find_sources(cloud(0.0, 0.0, 3), CONFIG)) == 1


def test_too_many_groups_are_dropped_and_too_few_are_not_split():
    fixes = cloud(0.0, 0.0, 9) + cloud(1.0, 0.0, 4, seed=1) + cloud(2.0, 0.0, 6, seed=2)
    assert places(fixes, replace(CONFIG, clusters=2)) == [(0.0, 0.0), (2.0, 0.0)]
    assert len(find_sources(cloud(0.0, 0.0, 30), replace(CONFIG, clusters=3))) == 1


def test_the_worst_fixes_of_a_source_are_no_source_of_their_own():
    fixes = cloud(0.0, 0.0, 40) + cloud(0.0, 0.45, 5, seed=1)
    assert places(fixes) == [(0.0, 0.0)]
    assert len(places(cloud(0.0, 0.0, 40) + cloud(0.0, 0.45, 20, seed=1))) == 2
    assert len(places(cloud(0.0, 0.0, 40) + cloud(0.0, 0.6, 5, seed=1))) == 2


def test_a_better_fix_weighs_more():
    fixes = [fix(0.2, 0.0, sigma=0.2)] * 5 + [fix(0.0, 0.0, sigma=0.02)] * 5
    (source,) = find_sources(fixes, CONFIG)
    assert source.x < 0.02


def test_a_source_knows_its_evidence():
    fixes = [fix(0.0, 0.0, range=r, peak=p) for r, p in ((1.0, 4.0), (0.4, 9.0), (2.0, 3.0))]
    (source,) = find_sources(fixes, CONFIG)
    assert (source.observations, source.nearest, source.peak) == (3, 0.4, 9.0)
    many = find_sources(fixes * 50, CONFIG)[0]
    assert 0.02**2 <= many.covariance[0] < source.covariance[0]
