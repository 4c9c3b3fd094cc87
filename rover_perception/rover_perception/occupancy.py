"""The published map: cells of the evidence grid, summed up."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_common.dataflow import GridMap
from rover_perception.evidence import EvidenceGrid

ENOUGH = 1.0  # evidence below one sure look leaves a cell unknown
# A cell is navigable when the rover, half a track (0.396 m) to either side of the cell's centre,
# stands on free ground: of a cell of 1 m that is the inner three quarters.
FREE_SHARE = 0.75


def occupancy_of(evidence: EvidenceGrid, resolution: float) -> GridMap:
    """OccupancyGrid cells: -1 unknown, below 50 navigable, else an obstacle.

    Inside a class, the value is the share [%] of the cell that is not free.
    """
    geometry = evidence.geometry
    count = round(resolution / geometry.resolution)
    seen = evidence.free + evidence.blocked >= ENOUGH
    free = seen & (evidence.free > evidence.blocked)
    free_share = _share(free, count)
    blocked_share = _share(seen & ~free, count)
    cells = np.full(free_share.shape, -1, np.int8)
    blocked = blocked_share > 1.0 - FREE_SHARE
    cells[blocked] = np.round(50 + 50 * blocked_share[blocked]).astype(np.int8)
    navigable = free_share >= FREE_SHARE
    cells[navigable] = np.round(100 * (1.0 - free_share[navigable])).astype(np.int8)
    return GridMap(resolution, geometry.origin_x, geometry.origin_y, cells)


def _share(mask: NDArray[np.bool_], count: int) -> NDArray[np.floating]:
    """Share of true cells in each block of count x count."""
    rows, cols = mask.shape[0] // count, mask.shape[1] // count
    blocks = mask[: rows * count, : cols * count].reshape(rows, count, cols, count)
    return blocks.mean(axis=(1, 3))
