"""The shortest way home over the breadcrumbs, its loops cut out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import KDTree

from rover_navigation.breadcrumbs import SPACING
from rover_navigation.costmap import Costmap

BESIDE = 1.0  # [m] crumbs this near to each other are linked in any case
ACROSS = 6.0  # [m] and up to here where the map shows free ground between them
ROOM = 0.6  # [m] from obstacles, of a link across
BLOCKED_COST = 10.0  # times its length, for a step through a place where the rover got stuck since
SAMPLES = 13  # points on which a link across is tried: one for each half metre


def way_over_crumbs(
    crumbs: NDArray[np.float64], position: tuple[float, float], costmap: Costmap
) -> NDArray[np.float64]:
    """Points (n, 2) [m] from the crumb nearest to the position back to the first of them.

    Loops are cut where the trail comes near to itself, and free ground lies between.
    """
    if len(crumbs) < 2:
        return crumbs
    tree = KDTree(crumbs)
    pairs = tree.query_pairs(ACROSS, output_type="ndarray")
    length = np.linalg.norm(crumbs[pairs[:, 0]] - crumbs[pairs[:, 1]], axis=1)
    along = np.diff(pairs, axis=1)[:, 0] == 1  # driven, however far a jump it was
    keep = along | (length <= BESIDE)
    across = np.flatnonzero(~keep)
    keep[across] = _clear(crumbs[pairs[across, 0]], crumbs[pairs[across, 1]], costmap)
    first, second = pairs[keep].T
    jumps = np.flatnonzero(np.linalg.norm(np.diff(crumbs, axis=0), axis=1) > ACROSS)
    first, second = np.append(first, jumps), np.append(second, jumps + 1)
    cost = np.linalg.norm(crumbs[first] - crumbs[second], axis=1)
    blocked = ~costmap.free[costmap.geometry.nearest_cell_to(crumbs[:, 0], crumbs[:, 1])]
    cost[blocked[first] | blocked[second]] *= BLOCKED_COST
    graph = csr_array((cost, (first, second)), shape=(len(crumbs), len(crumbs)))
    _, previous = dijkstra(graph, directed=False, indices=0, return_predecessors=True)
    index = int(tree.query(position)[1])
    way = [index]
    while way[-1] != 0:
        way.append(int(previous[way[-1]]))
    return _dense(crumbs[way])


def _clear(
    starts: NDArray[np.float64], ends: NDArray[np.float64], costmap: Costmap
) -> NDArray[np.bool_]:
    """Whether the straight lines between points (n, 2) [m] have room on the map."""
    share = np.linspace(0.0, 1.0, SAMPLES)[:, None, None]
    points = starts + share * (ends - starts)
    cell = costmap.geometry.nearest_cell_to(points[..., 0], points[..., 1])
    room = costmap.free[cell] & (costmap.clearance[cell] >= ROOM)
    return np.asarray(room.all(axis=0))


def _dense(way: NDArray[np.float64]) -> NDArray[np.float64]:
    """The way with a point for each half metre."""
    steps = np.linalg.norm(np.diff(way, axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    fine = np.linspace(0.0, at[-1], max(2, round(at[-1] / SPACING) + 1))
    return np.stack([np.interp(fine, at, way[:, axis]) for axis in (0, 1)], axis=1)
