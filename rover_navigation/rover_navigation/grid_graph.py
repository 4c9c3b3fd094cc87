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
Links = Mapping[Offset, tuple[Offset, ...]]
EIGHT: Links = {(0, 1): (), (1, 0): (), (1, 1): (), (1, -1): ()}


def node_numbers(passable: NDArray[np.bool_]) -> NDArray[np.int32]:
    """The node (rows, cols) of each passable cell, counted row by row; -1 where there is none."""
    numbers = np.full(passable.shape, -1, np.int32)
    numbers[passable] = np.arange(np.count_nonzero(passable))
    return numbers


def step_costs(
    passable: NDArray[np.bool_],
    pace: NDArray[np.floating],
    cell: float,
    links: Links = EIGHT,
) -> NDArray[np.floating]:
    """Costs (rows, cols, directions) of the steps from each cell, inf where one is closed.

    `pace` (rows, cols) is what a metre costs in each cell, `cell` [m] the size of one; a step costs
    its length times the mean pace of both ends. A cell's costs depend on the cells around it only.
    """
    index = {direction: number for number, direction in enumerate(_directions(links))}
    steps = np.full((*passable.shape, len(index)), np.inf, pace.dtype)
    for (down, right), between in links.items():
        here, there, *crossed = (
            _window(passable.shape, (down, right), at) for at in ((0, 0), (down, right), *between)
        )
        open_ = passable[here] & passable[there]
        for window in crossed:
            open_ &= passable[window]
        length = cell * float(np.hypot(down, right))
        cost = np.where(open_, 0.5 * length * (pace[here] + pace[there]), np.inf)
        steps[here][..., index[down, right]] = cost
        steps[there][..., index[-down, -right]] = cost
    return steps


def graph_of_steps(
    numbers: NDArray[np.int32], steps: NDArray[np.floating], links: Links = EIGHT
) -> csr_array:
    """Costs (nodes, nodes), given what `node_numbers` and `step_costs` say of each cell."""
    directions = np.array(_directions(links))
    reach = int(np.abs(directions).max())
    padded = np.pad(numbers, reach, constant_values=-1)
    shifts = directions @ (padded.shape[1], 1)
    rows, cols = np.divmod(np.flatnonzero(numbers >= 0), numbers.shape[1])
    cost = steps[rows, cols]
    open_ = np.isfinite(cost)
    cell = (rows + reach) * padded.shape[1] + cols + reach
    near = padded.ravel()[cell[:, None] + shifts][open_]
    ends = np.concatenate([[0], np.cumsum(open_.sum(axis=1))]).astype(np.int32)
    # SciPy's shortest paths want doubles.
    return csr_array((cost[open_].astype(np.float64), near, ends), shape=(len(rows), len(rows)))


def grid_graph(
    passable: NDArray[np.bool_],
    pace: NDArray[np.floating],
    cell: float,
    links: Links = EIGHT,
) -> csr_array:
    """Symmetric costs (nodes, nodes) of the steps from each passable cell to its neighbours."""
    steps = step_costs(passable, pace, cell, links)
    return graph_of_steps(node_numbers(passable), steps, links)


def _directions(links: Links) -> list[Offset]:
    """Of the links both ways, in the order of the cells that they lead to."""
    return sorted([*links, *((-down, -right) for down, right in links)])


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
