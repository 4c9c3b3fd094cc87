"""In which order to visit places, given the seconds between them, to end at home soonest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

MOST_STOPS = 9  # the exact solution takes time and memory with the power of this


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
    everything = (1 << count) - 1
    # to_end[left, stop]: shortest way from the stop through all of the set `left`, then the end
    to_end = np.full((everything + 1, count), np.inf)
    to_end[0] = last
    for left in range(1, everything + 1):
        members = [stop for stop in range(count) if left >> stop & 1]
        onward = [to_end[left & ~(1 << stop), stop] for stop in members]
        dropped = [to_end[left & ~(1 << stop)] + worth[stop] for stop in members]
        visit = (between[:, members] + np.array(onward)).min(axis=1)
        to_end[left] = np.minimum(visit, np.min(dropped, axis=0))
    rest = [to_end[everything & ~(1 << stop), stop] for stop in range(count)]
    return np.asarray(first + np.array(rest))
