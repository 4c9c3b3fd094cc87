"""Travel times over the map: a graph of drivable cells, and shortest ways through it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from rover_common.grid import GridGeometry
from rover_decision.planning.costmap import Costmap

COARSE = 2  # cells of the map per cell of the graph, in both directions
PADDING = 0.55  # [m] from obstacles: half the rover's width, and what a wheel may stray
ROOMY_REACH = 4.0  # [m] to a place with room on all sides; where none is as near, a narrow one does
# Speed that a cell can be driven with: by its room, between crawling and cruising.
SPEED_PER_ROOM = 1.5  # [1/s]
SLOWEST, FASTEST = 0.5, 2.5  # [m/s]


@dataclass(frozen=True)
class Ways:
    """Shortest ways from some nodes to all others."""

    seconds: NDArray[np.float64]  # (sources, nodes), inf where there is no way
    previous: NDArray[np.int32]  # (sources, nodes)


class Roadmap:
    """Nodes are drivable cells of the coarse grid."""

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
        self._roomy = self.drivable & (room >= PADDING)
        pace = 1.0 / np.clip(SPEED_PER_ROOM * room, SLOWEST, FASTEST)  # [s/m]
        self._numbers = np.full(self.drivable.shape, -1, np.int32)
        self._numbers[self.drivable] = np.arange(np.count_nonzero(self.drivable))
        rows, cols = np.nonzero(self.drivable)
        self.x, self.y = self.geometry.center_of(rows, cols)
        self._graph = self._links(pace)
        self._reachable = self.drivable

    def __len__(self) -> int:
        return len(self.x)

    def node_at(self, point: tuple[float, float], reach: float) -> int:
        """The node nearest to a point [m], in however narrow a place; -1 where none is in reach."""
        if len(self) == 0:
            return -1
        away = np.hypot(self.x - point[0], self.y - point[1])
        away[~self._reachable[self.drivable]] = np.inf
        node = int(np.argmin(away))
        return node if away[node] <= reach else -1

    def nodes_near(
        self, x: NDArray[np.float64], y: NDArray[np.float64], reach: float
    ) -> NDArray[np.int32]:
        """The node nearest to each point (n,) [m]; -1 where none is within `reach` [m].

        A node with room around it, where there is one within a few metres.
        """
        if len(self) == 0:
            return np.full(len(x), -1, np.int32)
        node, away = self._nodes_of(self._nearest_roomy, x, y)
        if (away > min(reach, ROOMY_REACH)).any():
            tight, nearer = self._nodes_of(self._nearest, x, y)
            far = away > min(reach, ROOMY_REACH)
            node, away = np.where(far, tight, node), np.where(far, nearer, away)
        return np.where(away <= reach, node, -1).astype(np.int32)

    def _nodes_of(
        self, nearest: NDArray[np.int32], x: NDArray[np.float64], y: NDArray[np.float64]
    ) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Nodes of the cells that are nearest to those of the points, and how far [m] they are."""
        row, col = self.geometry.cell_of(x, y)
        row = np.clip(row, 0, self.geometry.rows - 1)
        col = np.clip(col, 0, self.geometry.cols - 1)
        node = self._numbers[nearest[0][row, col], nearest[1][row, col]]
        away = np.where(node >= 0, np.hypot(self.x[node] - x, self.y[node] - y), np.inf)
        return node, away

    @cached_property
    def _nearest(self) -> NDArray[np.int32]:
        return _nearest_true(self._reachable)

    @cached_property
    def _nearest_roomy(self) -> NDArray[np.int32]:
        return _nearest_true(self._reachable & self._roomy)

    def only_reachable_from(self, node: int) -> None:
        """From now on, only nodes are given that can be driven to from this one."""
        regions, _ = ndimage.label(self.drivable, structure=np.ones((3, 3)))
        row, col = self.geometry.cell_of(self.x[node], self.y[node])
        self._reachable = regions == regions[row, col]
        for nearest in ("_nearest", "_nearest_roomy"):
            self.__dict__.pop(nearest, None)

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
            starts.append(self._numbers[here][both])
            ends.append(self._numbers[there][both])
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


def _nearest_true(mask: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Row and column (2, rows, cols) of the true cell nearest to each cell."""
    if not mask.any():
        return np.zeros((2, *mask.shape), np.int32)
    indices = ndimage.distance_transform_edt(~mask, return_distances=False, return_indices=True)
    return np.asarray(indices)
