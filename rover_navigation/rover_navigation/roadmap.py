"""Travel times over the map: a graph of drivable cells, and shortest ways through it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from rover_common.grid import GridGeometry
from rover_navigation.costmap import Costmap

COARSE = 2  # cells of the map per cell of the graph, in both directions
PADDING = 0.55  # [m] from obstacles: half the rover's width, and what a wheel may stray
# Speed that a cell can be driven with: by its room, between crawling and cruising.
SPEED_PER_ROOM = 1.5  # [1/s]
SLOWEST, FASTEST = 0.5, 2.5  # [m/s]


@dataclass(frozen=True)
class Ways:
    """Shortest ways from some nodes to all others."""

    seconds: NDArray[np.float64]  # (sources, nodes), inf where there is no way
    previous: NDArray[np.int32]  # (sources, nodes)


class Roadmap:
    """Nodes are drivable cells of the coarse grid.

    `drivable` and `roomy` (rows, cols): the cells that are nodes, and those with room on all sides;
    `numbers` (rows, cols): the node of each cell, -1 where there is none; `x` and `y` (nodes,) [m].
    """

    def __init__(self, costmap: Costmap) -> None:
        fine = costmap.geometry
        self.geometry = GridGeometry(
            fine.resolution * COARSE,
            fine.rows // COARSE,
            fine.cols // COARSE,
            fine.origin_x,
            fine.origin_y,
        )
        clearance = np.minimum.reduce(_parts(costmap.clearance))
        room = np.minimum.reduce(_parts(costmap.room))
        self.drivable = np.logical_and.reduce(_parts(costmap.free)) & (clearance >= PADDING)
        self.roomy = self.drivable & (room >= PADDING)
        pace = 1.0 / np.clip(SPEED_PER_ROOM * room, SLOWEST, FASTEST)  # [s/m]
        self.numbers = np.full(self.drivable.shape, -1, np.int32)
        self.numbers[self.drivable] = np.arange(np.count_nonzero(self.drivable))
        rows, cols = np.nonzero(self.drivable)
        self.x, self.y = self.geometry.center_of(rows, cols)
        self._graph = self._links(pace)

    def __len__(self) -> int:
        return len(self.x)

    def ways_from(self, sources: list[int]) -> Ways:
        """Shortest ways from each of the nodes."""
        seconds, previous = dijkstra(
            self._graph, indices=sources, return_predecessors=True, directed=True
        )
        return Ways(seconds, previous)

    def way(self, ways: Ways, source: int, target: int) -> NDArray[np.float64]:
        """Points (n, 2) [m] from source number `source` of the ways to a node, cell by cell."""
        nodes = [target]
        while (before := int(ways.previous[source, nodes[-1]])) >= 0:
            nodes.append(before)
        return np.stack([self.x[nodes[::-1]], self.y[nodes[::-1]]], axis=1)

    def _links(self, pace: NDArray[np.float64]) -> csr_array:
        """Symmetric: seconds from each node to its eight neighbours."""
        starts, ends, seconds = [], [], []
        rows, cols = self.drivable.shape
        for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
            here = (slice(0, rows - down), slice(max(0, -right), cols - max(0, right)))
            there = (slice(down, rows), slice(max(0, right), cols + min(0, right)))
            both = self.drivable[here] & self.drivable[there]
            length = self.geometry.resolution * float(np.hypot(down, right))
            starts.append(self.numbers[here][both])
            ends.append(self.numbers[there][both])
            seconds.append(0.5 * length * (pace[here] + pace[there])[both])
        start, end, cost = (np.concatenate(parts) for parts in (starts, ends, seconds))
        count = len(self)
        return csr_array(
            (
                np.concatenate([cost, cost]),
                (np.concatenate([start, end]), np.concatenate([end, start])),
            ),
            shape=(count, count),
        )


def _parts(cells: NDArray) -> list[NDArray]:
    """Of each cell of the graph the first of its cells, the second, and so on.

    To reduce these costs a fortieth of what `reshape` and a reduction over two short axes cost.
    """
    return [cells[row::COARSE, col::COARSE] for row in range(COARSE) for col in range(COARSE)]
