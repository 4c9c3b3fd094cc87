"""Breadcrumbs: where the rover has been, and the shortest way home over it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import KDTree

from rover_common.geometry import Pose

SPACING = 0.5  # [m] between crumbs
LINK = 1.0  # [m] crumbs this near to each other are linked, which cuts the loops out


class Crumbs:
    """The trail since the start."""

    def __init__(self) -> None:
        self._points: list[tuple[float, float]] = []

    def drop(self, pose: Pose) -> None:
        """Leave a crumb when the last one is far enough away."""
        point = (pose.x, pose.y)
        if not self._points or _distance(self._points[-1], point) >= SPACING:
            self._points.append(point)

    @property
    def points(self) -> NDArray[np.float64]:
        """(n, 2) [m] from the start on."""
        return np.array(self._points, float).reshape(-1, 2)

    def way_home(self, pose: Pose) -> NDArray[np.float64]:
        """Points (n, 2) [m] from the crumb nearest to the pose back to the start."""
        points = self.points
        if len(points) < 2:
            return points
        tree = KDTree(points)
        # Consecutive crumbs are linked however far a jump between them was.
        links = tree.sparse_distance_matrix(tree, LINK, output_type="coo_matrix").tolil()
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        for index, step in enumerate(steps):
            links[index, index + 1] = step
        _, previous = dijkstra(links.tocsr(), directed=False, indices=0, return_predecessors=True)
        index = int(tree.query((pose.x, pose.y))[1])
        way = [index]
        while way[-1] != 0:
            way.append(int(previous[way[-1]]))
        return points[way]


def _distance(a: tuple[float, float], b: tuple[float, float]) -> float:
    return float(np.hypot(a[0] - b[0], a[1] - b[1]))
