"""Part of a roadmap: which of its nodes is nearest to a place."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from rover_common.cell_region import CellRegion
from rover_navigation.roadmap import Roadmap


class NearestCells:
    """For each cell of a mask the nearest true cell, computed anew where the mask has changed."""

    def __init__(self, reach: int) -> None:
        """reach: [cells] beyond which a cell counts for none."""
        self._reach = reach
        self._mask = np.zeros((0, 0), bool)
        self._nearest = np.zeros((2, 0, 0), np.int32)

    def of(self, mask: NDArray[np.bool_]) -> NDArray[np.int32]:
        """Row and column (2, rows, cols), of any cell where no true one is within reach."""
        if mask.shape != self._mask.shape:
            self._mask = np.zeros_like(mask)
            self._nearest = np.zeros((2, *mask.shape), np.int32)
        changed = CellRegion.of_true(mask != self._mask)
        self._mask = mask
        if changed is not None:
            region = changed.grown(self._reach, mask.shape)
            around = region.grown(self._reach, mask.shape)
            nearest = _nearest_true(mask[around.slices])
            nearest[0] += around.row_start
            nearest[1] += around.col_start
            self._nearest[:, *region.slices] = nearest[:, *region.slices_in(around)]
        return self._nearest


class Region:
    """Some nodes of a roadmap, such as those that can be driven to."""

    def __init__(
        self,
        roadmap: Roadmap,
        members: NDArray[np.bool_],
        wide_reach: float,
        nearest: tuple[NearestCells, NearestCells] | None = None,
    ) -> None:
        """members (nodes,); wide_reach [m] to a wide place, beyond which a narrow one does.

        nearest: those of such a region before, and of its wide places.
        """
        self._roadmap = roadmap
        self._members = members
        self._wide_reach = wide_reach
        everywhere = max(roadmap.drivable.shape)
        self._nearest_cells = nearest or (NearestCells(everywhere), NearestCells(everywhere))
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
        node, away = self._nodes_of(self._nearest_wide, self._wide_cells, x, y)
        far = away > min(reach, self._wide_reach)
        if far.any():
            narrow, nearer = self._nodes_of(self._nearest, self._cells, x, y)
            node, away = np.where(far, narrow, node), np.where(far, nearer, away)
        return np.where(away <= reach, node, -1).astype(np.int32)

    def _nodes_of(
        self,
        nearest: NDArray[np.int32],
        cells: NDArray[np.bool_],
        x: NDArray[np.float64],
        y: NDArray[np.float64],
    ) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Nodes of the cells that are nearest to those of the points, and how far [m] they are.

        `nearest` of `cells`; what it names is none of them where there is none in its reach.
        """
        roadmap = self._roadmap
        row, col = roadmap.geometry.nearest_cell_to(x, y)
        row, col = nearest[:, row, col]
        node = roadmap.numbers[row, col]
        away = np.hypot(roadmap.x[node] - x, roadmap.y[node] - y)
        return node, np.where(cells[row, col], away, np.inf)

    @cached_property
    def _nearest(self) -> NDArray[np.int32]:
        return self._nearest_cells[0].of(self._cells)

    @cached_property
    def _nearest_wide(self) -> NDArray[np.int32]:
        return self._nearest_cells[1].of(self._wide_cells)

    @cached_property
    def _wide_cells(self) -> NDArray[np.bool_]:
        return np.asarray(self._cells & self._roadmap.wide)


def _nearest_true(mask: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Row and column (2, rows, cols) of the true cell nearest to each cell."""
    if not mask.any():
        return np.zeros((2, *mask.shape), np.int32)
    indices = ndimage.distance_transform_edt(~mask, return_distances=False, return_indices=True)
    return np.asarray(indices)
