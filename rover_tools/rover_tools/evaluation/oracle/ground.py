"""The ground as the oracle knows it: paths between cells, and which cell sees which."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import KDTree

from rover_navigation.grid_graph import Offset, grid_graph

SIGHT_STEP = 0.5  # [m] between the sampled points of a line of sight
CELL = 1.0  # [m]
# Half of the sixteen directions (rows, columns) with the cells between that must be navigable.
LINKS: dict[Offset, tuple[Offset, ...]] = {
    (0, 1): (),
    (1, 0): (),
    (1, 1): ((0, 1), (1, 0)),
    (1, -1): ((0, -1), (1, 0)),
    (1, 2): ((0, 1), (1, 1)),
    (2, 1): ((1, 0), (1, 1)),
    (1, -2): ((0, -1), (1, -1)),
    (2, -1): ((1, 0), (1, -1)),
}


class OracleGround:
    """The cells of 1 m that can be reached from the start, numbered by row and column."""

    def __init__(self, navigable: NDArray[np.bool_], start: tuple[float, float]) -> None:
        """start [m]."""
        labels, _ = ndimage.label(navigable)
        rows, cols = np.nonzero(navigable)
        first = int(np.argmin(np.hypot(cols + 0.5 - start[0], rows + 0.5 - start[1])))
        self.cells = labels == labels[rows[first], cols[first]]
        rows, cols = np.nonzero(self.cells)
        centers = np.stack([cols, rows], axis=1) + 0.5
        self.centers = centers.astype(np.float64)  # (n, 2) [m]
        self._links = grid_graph(self.cells, np.ones(self.cells.shape), CELL, LINKS)

    def __len__(self) -> int:
        return len(self.centers)

    def nearest(self, point: tuple[float, float]) -> int:
        """The cell whose centre is nearest to a point [m]."""
        return int(np.argmin(np.hypot(*(self.centers - point).T)))

    def paths_from(self, sources: list[int]) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """Shortest distances [m] and predecessors, both (sources, cells)."""
        metres, before = dijkstra(
            self._links, directed=False, indices=sources, return_predecessors=True
        )
        return metres, before

    def sight(self, reach: float) -> NDArray[np.bool_]:
        """Which cells see each other within a reach [m], (n, n), symmetric, true on the diagonal.

        A line of sight is blocked by any cell between that is not navigable.
        """
        pairs = KDTree(self.centers).query_pairs(reach, output_type="ndarray")
        pairs = pairs[np.lexsort(pairs.T)]
        steps = int(np.ceil(reach / SIGHT_STEP))
        for step in range(1, steps):
            share = step / steps
            ends = self.centers[pairs]  # (pairs, 2, 2)
            points = (1 - share) * ends[:, 0] + share * ends[:, 1]
            cols, rows = np.floor(points).astype(np.intp).T
            pairs = pairs[self.cells[rows, cols]]
        sees = np.eye(len(self), dtype=bool)
        sees[pairs[:, 0], pairs[:, 1]] = sees[pairs[:, 1], pairs[:, 0]] = True
        return sees
