"""A grid of passable cells as a graph, and shortest paths through graphs.

SciPy solves the shortest paths; it has no constructor for grids with diagonals and costs, and no
function that reads one path out of its predecessors.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

Offset = tuple[int, int]  # rows down, columns right
# Half of the directions, with the cells in between that must be passable too; the other half by
# symmetry.
EIGHT: Mapping[Offset, tuple[Offset, ...]] = {(0, 1): (), (1, 0): (), (1, 1): (), (1, -1): ()}


def node_numbers(passable: NDArray[np.bool_]) -> NDArray[np.int32]:
    """The node (rows, cols) of each passable cell, counted row by row; -1 where there is none."""
    numbers = np.full(passable.shape, -1, np.int32)
    numbers[passable] = np.arange(np.count_nonzero(passable))
    return numbers


def grid_graph(
    passable: NDArray[np.bool_],
    pace: NDArray[np.floating],
    cell: float,
    links: Mapping[Offset, tuple[Offset, ...]] = EIGHT,
) -> csr_array:
    """Symmetric costs (nodes, nodes) of the steps from each passable cell to its neighbours.

    `pace` (rows, cols) is what a metre costs in each cell, `cell` [m] the size of one; a step costs
    its length times the mean pace of both ends.
    """
    numbers = node_numbers(passable)
    starts, ends, costs = [], [], []
    for offset, between in links.items():
        here, there, *crossed = (
            _window(passable.shape, offset, at) for at in ((0, 0), offset, *between)
        )
        open_ = passable[here] & passable[there]
        for window in crossed:
            open_ &= passable[window]
        length = cell * float(np.hypot(*offset))
        starts.append(numbers[here][open_])
        ends.append(numbers[there][open_])
        costs.append(0.5 * length * (pace[here] + pace[there])[open_])
    start, end = np.concatenate(starts), np.concatenate(ends)
    cost = np.concatenate(costs).astype(np.float64)  # as SciPy's shortest paths want it
    count = int(np.count_nonzero(passable))
    both = (np.concatenate([start, end]), np.concatenate([end, start]))
    return csr_array((np.concatenate([cost, cost]), both), shape=(count, count))


def _window(shape: tuple[int, ...], offset: Offset, at: Offset) -> tuple[slice, slice]:
    """The cells at `at` from all cells that have a neighbour at `offset` within the grid."""
    rows, cols = shape
    (down, right), (row, col) = offset, at
    return (
        slice(row, rows - down + row),
        slice(max(0, -right) + col, cols - max(0, right) + col),
    )


def path_nodes(predecessors: NDArray[np.int32], target: int) -> list[int]:
    """The nodes from the source to a target; predecessors (nodes,) as scipy's dijkstra has them."""
    nodes = [target]
    while (before := int(predecessors[nodes[-1]])) >= 0:
        nodes.append(before)
    return nodes[::-1]
