"""Part of a roadmap: which of its nodes is nearest to a place."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from rover_navigation.roadmap import Roadmap


class Region:
    """Some nodes of a roadmap, such as those that can be driven to."""

    def __init__(self, roadmap: Roadmap, members: NDArray[np.bool_], wide_reach: float) -> None:
        """members (nodes,); wide_reach [m] to a wide place, beyond which a narrow one does."""
        self._roadmap = roadmap
        self._members = members
        self._wide_reach = wide_reach
        self._cells = np.zeros_like(roadmap.drivable)
        self._cells[roadmap.drivable] = members

    @classmethod
    def everywhere(cls, roadmap: Roadmap, wide_reach: float) -> Region:
        return cls(roadmap, np.ones(len(roadmap), bool), wide_reach)

    def node_at(self, point: tuple[float, float], reach: float) -> int:
        """The node nearest to a point [m], in however narrow a place; -1 where none is in reach."""
        if not self._members.any():
            return -1
        away = np.hypot(self._roadmap.x - point[0], self._roadmap.y - point[1])
        away[~self._members] = np.inf
        node = int(np.argmin(away))
        return node if away[node] <= reach else -1

    def nodes_near(
        self, x: NDArray[np.float64], y: NDArray[np.float64], reach: float
    ) -> NDArray[np.int32]:
        """The node nearest to each point (n,) [m]; -1 where none is within `reach` [m].

        A wide one, where there is one within a few metres.
        """
        if not self._members.any():
            return np.full(len(x), -1, np.int32)
        node, away = self._nodes_of(self._nearest_wide, x, y)
        far = away > min(reach, self._wide_reach)
        if far.any():
            narrow, nearer = self._nodes_of(self._nearest, x, y)
            node, away = np.where(far, narrow, node), np.where(far, nearer, away)
        return np.where(away <= reach, node, -1).astype(np.int32)

    def _nodes_of(
        self, nearest: NDArray[np.int32], x: NDArray[np.float64], y: NDArray[np.float64]
    ) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Nodes of the cells that are nearest to those of the points, and how far [m] they are."""
        roadmap = self._roadmap
        row, col = roadmap.geometry.nearest_cell_to(x, y)
        node = roadmap.numbers[nearest[0][row, col], nearest[1][row, col]]
        away = np.where(node >= 0, np.hypot(roadmap.x[node] - x, roadmap.y[node] - y), np.inf)
        return node, away

    @cached_property
    def _nearest(self) -> NDArray[np.int32]:
        return _nearest_true(self._cells)

    @cached_property
    def _nearest_wide(self) -> NDArray[np.int32]:
        return _nearest_true(self._cells & self._roadmap.wide)


def _nearest_true(mask: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Row and column (2, rows, cols) of the true cell nearest to each cell."""
    if not mask.any():
        return np.zeros((2, *mask.shape), np.int32)
    indices = ndimage.distance_transform_edt(~mask, return_distances=False, return_indices=True)
    return np.asarray(indices)
