"""A short round trip over the ground that passes some cells and sees all others."""

from __future__ import annotations

from itertools import pairwise

import networkx as nx
import numpy as np
from networkx.algorithms.approximation import christofides, threshold_accepting_tsp
from numpy.typing import NDArray

from rover_navigation.grid_graph import path_nodes
from rover_tools.evaluation.oracle.ground import OracleGround

NEARBY = 6.0  # [m] within which a better viewpoint is sought
SHORTER = 0.1  # [m] that a change must save

Cells = NDArray[np.intp]
Mask = NDArray[np.bool_]


class RoundTrip:
    """An order of stops: the start first, the samples, and viewpoints, which may be moved.

    A cell counts as seen when it is seen from any cell on the shortest paths between the stops.
    """

    def __init__(self, ground: OracleGround, sight: Mask, start: int, samples: list[int]) -> None:
        """sight (n, n): which cells see each other."""
        self._ground = ground
        self._sight = sight
        self._stands = {start, *samples}
        self._stops = [start, *sorted(self._stands - {start})]
        self._paths: dict[int, tuple[NDArray[np.float64], NDArray[np.int32]]] = {}
        self.order()

    def metres(self) -> float:
        """Length of the trip."""
        return sum(self._distances(a)[b] for a, b in self._legs())

    def metres_between_stands(self) -> list[float]:
        """Lengths between the cells that are stopped at: the start and the samples."""
        lengths = [0.0]
        for a, b in self._legs():
            lengths[-1] += float(self._distances(a)[b])
            if b in self._stands:
                lengths.append(0.0)
        return lengths[:-1]

    def path(self) -> Cells:
        """All cells along it; the start first and last."""
        paths = [self._path(a, b)[1:] for a, b in self._legs()]
        return np.concatenate([[self._stops[0]], *paths]).astype(np.intp)

    def order(self) -> None:
        """Bring the stops into an order that makes the trip short."""
        if len(self._stops) < 4:
            return  # all orders are the same trip
        between = np.array([self._distances(stop)[self._stops] for stop in self._stops])
        graph = nx.from_numpy_array(between)
        tour = christofides(graph)
        tour = threshold_accepting_tsp(graph, tour, source=tour[0], seed=0)[:-1]
        first = tour.index(0)
        ordered = [self._stops[index] for index in (*tour[first:], *tour[:first])]
        now, self._stops = self._stops, ordered
        shorter = self.metres()
        self._stops = now
        if shorter < self.metres():
            self._stops = ordered

    def add_viewpoints(self) -> None:
        """Add the cell that sees most of the unseen cells, until all are seen."""
        unseen = ~self._seen(self._legs())
        while unseen.any():
            best = int(np.argmax(np.count_nonzero(self._sight[:, unseen], axis=1)))
            unseen &= ~self._sight[best]
            self._stops.append(best)
        self.order()

    def drop_or_move_viewpoints(self) -> None:
        """Leave out viewpoints that are not needed; move the others where they cost less."""
        for stop in [stop for stop in self._stops if stop not in self._stands]:
            index = self._stops.index(stop)
            before, after = self._stops[index - 1], self._stops[(index + 1) % len(self._stops)]
            others = [leg for leg in self._legs() if stop not in leg]
            unseen = ~self._seen(others)
            if self._sees(unseen, before, after):
                del self._stops[index]
                continue
            detour = self._distances(before) + self._distances(after)
            away = np.hypot(*(self._ground.centers - self._ground.centers[stop]).T)
            cheaper = np.flatnonzero((away <= NEARBY) & (detour < detour[stop] - SHORTER))
            for cell in cheaper[np.argsort(detour[cheaper], kind="stable")].tolist():
                if self._sees(unseen, before, cell, after):
                    self._stops[index] = cell
                    break

    def _legs(self) -> list[tuple[int, int]]:
        return list(pairwise([*self._stops, self._stops[0]]))

    def _sees(self, wanted: Mask, *stops: int) -> bool:
        """Whether all wanted cells are seen on the path over these stops."""
        path = np.concatenate([self._path(a, b) for a, b in pairwise(stops)])
        return bool(self._sight[np.ix_(path, wanted)].any(axis=0).all())

    def _seen(self, legs: list[tuple[int, int]]) -> Mask:
        seen = self._sight[self._stops[0]].copy()
        for a, b in legs:
            seen |= self._sight[self._path(a, b)].any(axis=0)
        return seen

    def _distances(self, stop: int) -> NDArray[np.float64]:
        return self._paths_from(stop)[0]

    def _path(self, a: int, b: int) -> Cells:
        """Cells of the shortest path, both ends included."""
        source, target = (b, a) if a not in self._paths and b in self._paths else (a, b)
        before = self._paths_from(source)[1]
        cells = path_nodes(before, target)
        return np.array(cells[:: 1 if source == a else -1], np.intp)

    def _paths_from(self, stop: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        if stop not in self._paths:
            metres, before = self._ground.paths_from([stop])
            self._paths[stop] = metres[0], before[0]
        return self._paths[stop]
