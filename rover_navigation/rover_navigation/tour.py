"""The order in which to visit places, given the seconds between them, to be home soonest."""

from __future__ import annotations

from functools import cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

MOST_STOPS = 9  # time and memory of the exact solution grow exponentially with this


def tour_costs(
    first: NDArray[np.float64],
    between: NDArray[np.float64],
    last: NDArray[np.float64],
    worth: NDArray[np.float64],
) -> NDArray[np.float64]:
    """For each stop (n,), the least cost [s] of a tour to the end that begins with it.

    `first` (n,) [s] to each stop from where the rover is, `between` (n, n), `last` (n,) from each
    stop to the end; `worth` (n,) [s] is what a stop left out costs. Held and Karp's recursion over
    the sets of stops still to visit.
    """
    count = len(first)
    if count > MOST_STOPS:
        raise ValueError(f"{count} stops, at most {MOST_STOPS}")
    # to_end[left, stop]: shortest path from the stop through all of the set `left`, then the end
    to_end = np.full((1 << count, count), np.inf)
    to_end[0] = last
    for sets, members in _sets_by_size(count):
        fewer = sets[:, None] & ~(1 << members)  # (sets, size): without each of the members
        onward = to_end[fewer, members]
        visit = (between[:, members] + onward).min(axis=-1).T
        skip = (to_end[fewer] + worth[members][:, :, None]).min(axis=1)
        to_end[sets] = np.minimum(visit, skip)
    stops = np.arange(count)
    others = (1 << count) - 1 & ~(1 << stops)
    return np.asarray(first + to_end[others, stops])


@cache
def _sets_by_size(count: int) -> list[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """For each size from 1 to `count`, the sets of stops as bits (n,), and members (n, size)."""
    stops = range(count)
    by_size = [np.array(list(combinations(stops, size))) for size in range(1, count + 1)]
    return [((1 << members).sum(axis=1), members) for members in by_size]
