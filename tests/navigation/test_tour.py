"""Tours over a few stops, against all their orders."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rover_navigation.tour import MOST_STOPS, tour_costs


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 6), st.integers(0, 10_000))
def test_tours_are_the_shortest(count, seed):
    random = np.random.default_rng(seed)
    first, last = random.uniform(1, 50, count), random.uniform(1, 50, count)
    between = random.uniform(1, 50, (count, count))
    worth = np.where(random.random(count) < 0.5, np.inf, random.uniform(-3, 60, count))
    costs = tour_costs(first, between, last, worth)
    for start in range(count):
        others = [stop for stop in range(count) if stop != start]
        orders = [
            (start, *rest)
            for length in range(count)
            for rest in itertools.permutations(others, length)
        ]
        onward = [sum(between[a, b] for a, b in itertools.pairwise(order)) for order in orders]
        missed = [sum(worth[stop] for stop in others if stop not in order) for order in orders]
        best = min(
            first[start] + seconds + last[order[-1]] + missing
            for order, seconds, missing in zip(orders, onward, missed, strict=True)
        )
        assert costs[start] == pytest.approx(best)


def test_too_many_stops_are_refused():
    count = MOST_STOPS + 1
    with pytest.raises(ValueError, match="at most"):
        tour_costs(np.ones(count), np.ones((count, count)), np.ones(count), np.ones(count))
