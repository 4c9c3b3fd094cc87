"""The shortest path home over the breadcrumbs, its loops cut out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import KDTree

from rover_navigation.costmap import Costmap
from rover_navigation.grid_graph import path_nodes
from rover_navigation.scale import Scale

BLOCKED_COST = 10.0  # times its length, for a step through a place where the robot got stuck since
SAMPLES = 13  # points on which a shortcut is tried


def breadcrumb_path(
    breadcrumbs: NDArray[np.float64],
    position: tuple[float, float],
    costmap: Costmap,
    scale: Scale,
) -> NDArray[np.float64]:
    """Points (n, 2) [m] from the breadcrumb nearest to the position back to the first one.

    Loops are cut where the trail comes near to itself, and where free ground lies in between. The
    breadcrumbs (n, 2) [m] may leave the costmap.
    """
    if len(breadcrumbs) < 2:
        return breadcrumbs
    tree = KDTree(breadcrumbs)
    first, second = _links(breadcrumbs, tree, costmap, scale)
    cost = np.linalg.norm(breadcrumbs[first] - breadcrumbs[second], axis=1)
    cell = costmap.geometry.nearest_cell_to(breadcrumbs[:, 0], breadcrumbs[:, 1])
    blocked = ~costmap.free[cell]
    cost[blocked[first] | blocked[second]] *= BLOCKED_COST
    graph = csr_array((cost, (first, second)), shape=(len(breadcrumbs), len(breadcrumbs)))
    _, predecessors = dijkstra(graph, directed=False, indices=0, return_predecessors=True)
    nearest = int(tree.query(position)[1])
    return _dense(breadcrumbs[path_nodes(predecessors, nearest)[::-1]], scale.breadcrumb_spacing)


def _links(
    breadcrumbs: NDArray[np.float64], tree: KDTree, costmap: Costmap, scale: Scale
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs of breadcrumbs between which the robot may drive."""
    pairs = tree.query_pairs(scale.breadcrumb_shortcut, output_type="ndarray")
    length = np.linalg.norm(breadcrumbs[pairs[:, 0]] - breadcrumbs[pairs[:, 1]], axis=1)
    driven = np.diff(pairs, axis=1)[:, 0] == 1  # however far a jump it was
    keep = driven | (length <= scale.breadcrumb_link)
    short = np.flatnonzero(~keep)
    starts, ends = breadcrumbs[pairs[short, 0]], breadcrumbs[pairs[short, 1]]
    keep[short] = _clear(starts, ends, costmap, scale.shortcut_clearance)
    first, second = pairs[keep].T
    steps = np.linalg.norm(np.diff(breadcrumbs, axis=0), axis=1)
    jumps = np.flatnonzero(steps > scale.breadcrumb_shortcut)
    return np.append(first, jumps), np.append(second, jumps + 1)


def _clear(
    starts: NDArray[np.float64], ends: NDArray[np.float64], costmap: Costmap, clearance: float
) -> NDArray[np.bool_]:
    """Whether the straight lines between points (n, 2) [m] have clearance [m] on the map."""
    share = np.linspace(0.0, 1.0, SAMPLES)[:, None, None]
    points = starts + share * (ends - starts)
    cell = costmap.geometry.nearest_cell_to(points[..., 0], points[..., 1])
    clear = costmap.free[cell] & (costmap.clearance[cell] >= clearance)
    return np.asarray(clear.all(axis=0))


def _dense(path: NDArray[np.float64], spacing: float) -> NDArray[np.float64]:
    """The path with a point at each spacing [m]."""
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    fine = np.linspace(0.0, along[-1], max(2, round(along[-1] / spacing) + 1))
    return np.stack([np.interp(fine, along, path[:, axis]) for axis in (0, 1)], axis=1)
