"""The published maps, derived from the evidence."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.cell_region import CellRegion
from rover_common.map_encoding import EDGE, FREE_SHARE, UNKNOWN
from rover_common.types import GridMap
from rover_perception.mapping.evidence import EvidenceGrid

ENOUGH = 0.5  # certain observations; with less, a cell is more likely unobserved than observed

Masks = tuple[NDArray[np.bool_], NDArray[np.bool_], NDArray[np.bool_]]  # free, blocked, edge


class OccupancyMaps:
    """The world map, and the navigation map at the resolution of the evidence.

    Both are kept, and only cells whose evidence has changed are derived again.
    """

    def __init__(self, evidence: EvidenceGrid, resolution: float) -> None:
        """`resolution` [m] of the world map: a multiple of the evidence's."""
        geometry = evidence.geometry
        self._evidence = evidence
        self._resolution = resolution
        self._count = round(resolution / geometry.resolution)
        shape = geometry.rows // self._count, geometry.cols // self._count
        self._world = np.full(shape, UNKNOWN, np.int8)
        self._navigation = np.full((geometry.rows, geometry.cols), UNKNOWN, np.int8)

    def world_map(self) -> GridMap:
        """OccupancyGrid cells: -1 unknown, below 50 navigable, above an obstacle, and EDGE.

        Within these classes, the value is the share [%] of the cell that is not free.
        """
        self._update()
        geometry = self._evidence.geometry
        return GridMap(self._resolution, geometry.origin_x, geometry.origin_y, self._world.copy())

    def navigation_map(self) -> GridMap:
        """The same in the cells of the evidence."""
        self._update()
        geometry = self._evidence.geometry
        return GridMap(
            geometry.resolution, geometry.origin_x, geometry.origin_y, self._navigation.copy()
        )

    def _update(self) -> None:
        changed = self._evidence.take_changed()
        if changed is None:
            return
        blocks = changed.in_blocks(self._count)
        region = blocks.in_cells(self._count)
        masks = _masks_in(self._evidence, region)
        self._navigation[region.slices] = _cells_of(*masks)
        self._world[blocks.slices] = _cells_of_blocks(*masks, self._count)


def free_shares(evidence: EvidenceGrid, resolution: float) -> NDArray[np.floating]:
    """The share (rows, cols) of each cell of a resolution [m] that is free."""
    is_free, _, _ = _masks_in(evidence, CellRegion.of_grid(evidence.geometry))
    return _share(is_free, round(resolution / evidence.geometry.resolution))


def _masks_in(evidence: EvidenceGrid, region: CellRegion) -> Masks:
    """Which cells of a region are free, are blocked, or are an edge observed from afar."""
    free_observations = evidence.free_observations[region.slices]
    base_observations = evidence.base_observations[region.slices]
    edge_observations = evidence.edge_observations[region.slices]
    is_free = evidence.free[region.slices] > evidence.blocked[region.slices]
    # A cell that is only guessed to lie behind an obstacle stays unknown.
    blocked = ~is_free & (base_observations >= ENOUGH)
    is_free &= free_observations + base_observations >= ENOUGH
    edge = ~is_free & ~blocked & (base_observations + edge_observations >= ENOUGH)
    return is_free, blocked, edge


def _cells_of(
    is_free: NDArray[np.bool_], blocked: NDArray[np.bool_], edge: NDArray[np.bool_]
) -> NDArray[np.int8]:
    """Map cells (rows, cols), one for each cell of the masks."""
    cells = np.full(is_free.shape, UNKNOWN, np.int8)
    cells[edge] = EDGE
    cells[blocked] = 100
    cells[is_free] = 0
    return cells


def _cells_of_blocks(
    is_free: NDArray[np.bool_], blocked: NDArray[np.bool_], edge: NDArray[np.bool_], count: int
) -> NDArray[np.int8]:
    """Map cells (rows, cols), one for each block of `count` x `count` cells of the masks."""
    free_share, blocked_share = _share(is_free, count), _share(blocked, count)
    edge_share = _share(edge, count)
    cells = np.full(free_share.shape, UNKNOWN, np.int8)
    cells[edge_share + blocked_share > 1.0 - FREE_SHARE] = EDGE
    obstacle = blocked_share > 1.0 - FREE_SHARE
    cells[obstacle] = np.round(50 + 50 * blocked_share[obstacle]).astype(np.int8)
    navigable = free_share >= FREE_SHARE
    cells[navigable] = np.round(100 * (1.0 - free_share[navigable])).astype(np.int8)
    return cells


def _share(mask: NDArray[np.bool_], count: int) -> NDArray[np.floating]:
    """Share of true cells in each block of `count` x `count`; incomplete blocks are left out."""
    rows, cols = mask.shape[0] // count, mask.shape[1] // count
    whole = mask[: rows * count, : cols * count].astype(np.float32)
    return np.asarray(cv2.resize(whole, (cols, rows), interpolation=cv2.INTER_AREA))
