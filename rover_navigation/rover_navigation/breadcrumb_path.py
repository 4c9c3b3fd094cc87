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
# Breadcrumbs of one place that are told apart, however often the robot comes back to it: the graph
# grows with the ground that was driven, not with the time. A place is as wide as their spacing.
VISITS = 4
# [m] Shortcuts over free ground begin and end at one breadcrumb of each place of this width: a wide
# place where the robot circled for long has hundreds of them and not millions.
SHORTCUT_PLACE = 1.5


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
    kept, node = _places(breadcrumbs, scale.breadcrumb_spacing)
    points = breadcrumbs[kept]
    tree = KDTree(points)
    first, second = _links(points, node, tree, costmap, scale)
    cost = np.linalg.norm(points[first] - points[second], axis=1)
    cell = costmap.geometry.nearest_cell_to(points[:, 0], points[:, 1])
    blocked = ~costmap.free[cell]
    cost[blocked[first] | blocked[second]] *= BLOCKED_COST
    graph = csr_array((cost, (first, second)), shape=(len(points), len(points)))
    _, predecessors = dijkstra(graph, directed=False, indices=0, return_predecessors=True)
    nearest = int(tree.query(position)[1])
    return _dense(points[path_nodes(predecessors, nearest)[::-1]], scale.breadcrumb_spacing)


def _places(
    breadcrumbs: NDArray[np.float64], width: float, visits: int = VISITS
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The breadcrumbs (k,) that stay, and the one of them (n,) that each breadcrumb becomes.

    The first ones of each place [m], as many as the visits, stay; all later ones become the last of
    these.
    """
    _, place = np.unique(np.floor(breadcrumbs / width), axis=0, return_inverse=True)
    order = np.argsort(place.ravel(), kind="stable")
    count = np.bincount(place.ravel())
    begin = (np.cumsum(count) - count).repeat(count)  # of its place in the order
    visit = np.arange(len(order)) - begin
    stays = np.empty(len(order), np.intp)
    stays[order] = order[begin + np.minimum(visit, visits - 1)]
    kept, node = np.unique(stays, return_inverse=True)
    return kept, node.ravel()


def _links(
    points: NDArray[np.float64],
    node: NDArray[np.intp],
    tree: KDTree,
    costmap: Costmap,
    scale: Scale,
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs of points (n, 2) [m] between which the robot may drive; it drove from node to node."""
    steps = np.sort(np.stack([node[:-1], node[1:]], axis=1), axis=1)
    driven = np.unique(_key(steps[steps[:, 0] < steps[:, 1]], len(points)))
    linked = tree.query_pairs(scale.breadcrumb_link, output_type="ndarray")
    some = _places(points, SHORTCUT_PLACE, visits=1)[0]
    pairs = some[KDTree(points[some]).query_pairs(scale.breadcrumb_shortcut, output_type="ndarray")]
    clear = _clear(points[pairs[:, 0]], points[pairs[:, 1]], costmap, scale.shortcut_clearance)
    keys = [driven, _key(linked, len(points)), _key(pairs[clear], len(points))]
    first, second = np.divmod(np.unique(np.concatenate(keys)), len(points))
    return first, second


def _key(pairs: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """One number per pair (n, 2) of the first `count` numbers."""
    return np.asarray(pairs[:, 0] * count + pairs[:, 1])


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
