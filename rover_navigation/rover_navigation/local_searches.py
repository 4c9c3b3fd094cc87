"""Travel times between places, by searches that are kept until the ground changes under them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

SLACK = 3.0  # [s] that a search goes farther than it must: the next plan asks for a little more


@dataclass(frozen=True)
class _Search:
    """From one cell to all that are near."""

    number: int  # of this search
    limit: float  # [s] to where it went
    cells: NDArray[np.intp]  # (n,) that it reached
    seconds: NDArray[np.float64]  # (n,) to these
    reached: NDArray[np.bool_]  # (cells,) of the grid


class LocalSearches:
    """Those of the last plan on one grid, whose cells are counted row by row."""

    def __init__(self) -> None:
        self._kept: dict[int, _Search] = {}  # by the cell that they begin at
        self._between: dict[tuple[int, int], float] = {}  # [s] by the numbers of both searches
        self._numbers = count()

    def forget(self, cells: NDArray[np.intp]) -> None:
        """Steps from these cells (n,) have changed: drop each search that has made one."""
        self._kept = {
            start: search for start, search in self._kept.items() if not search.reached[cells].any()
        }

    def seconds_between(
        self,
        graph: csr_array,
        numbers: NDArray[np.int32],
        cells: NDArray[np.intp],
        nodes: list[int],
        limits: NDArray[np.float64],
        from_here: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Travel times (n, n) between nodes, over where the searches from both meet.

        `numbers` (cells,) are the nodes of the grid's cells, `cells` those of all nodes. A search
        goes as far as its limit (n,) [s], and a little farther where it will be of use again:
        beyond that limit from the robot, in seconds (n,), where nothing changes.
        """
        fresh: dict[int, NDArray[np.float64]] = {}  # [s] to each node
        searches = []
        for node, limit, here in zip(nodes, limits.tolist(), from_here.tolist(), strict=True):
            search = self._kept.get(int(cells[node]))
            if search is None or search.limit < limit:
                limit += SLACK if here > limit + SLACK else 0.0
                seconds = dijkstra(graph, indices=node, limit=limit)
                search = self._keep(cells, node, limit, seconds, len(numbers))
                fresh[search.number] = seconds
            searches.append(search)
        self._kept = dict(zip(cells[nodes].tolist(), searches, strict=True))
        return self._meetings(searches, fresh, numbers)

    def _keep(
        self,
        cells: NDArray[np.intp],
        node: int,
        limit: float,
        seconds: NDArray[np.float64],
        size: int,
    ) -> _Search:
        near = np.flatnonzero(np.isfinite(seconds))
        reached = np.zeros(size, bool)
        reached[cells[near]] = True
        search = _Search(next(self._numbers), limit, cells[near], seconds[near], reached)
        self._kept[int(cells[node])] = search
        return search

    def _meetings(
        self,
        searches: list[_Search],
        fresh: dict[int, NDArray[np.float64]],
        numbers: NDArray[np.int32],
    ) -> NDArray[np.float64]:
        """(n, n) [s] from the beginning of one search to that of another."""
        known, self._between = self._between, {}
        between = np.zeros((len(searches), len(searches)))
        for row, one in enumerate(searches):
            for col, other in enumerate(searches[:row]):
                pair = (one.number, other.number)
                if one is other:
                    continue  # two stops at one cell
                if pair not in known:
                    new, old = (one, other) if one.number in fresh else (other, one)
                    onward = fresh[new.number][numbers[old.cells]]
                    known[pair] = float((old.seconds + onward).min())
                self._between[pair] = self._between[pair[::-1]] = known[pair]
                between[row, col] = between[col, row] = known[pair]
        return between
