"""The published map: cells of the evidence grid, summed up."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.map_encoding import EDGE
from rover_common.types import GridMap
from rover_perception.mapping.evidence import EvidenceGrid

ENOUGH = 0.5  # sure looks; with less, a cell is more likely unseen than seen
# Navigable cells of the simulator's map lie about 0.4 m inside the flat floor, and sand is seen as
# ground up to 0.1 to 0.3 m from the floor's edge: a cell on the map is free over more than half of
# its area. Between half and all of it, this share was found on generated canyons.
FREE_SHARE = 0.65


def occupancy_of(evidence: EvidenceGrid, resolution: float) -> GridMap:
    """OccupancyGrid cells: -1 unknown, below 50 navigable, above an obstacle, and EDGE.

    Inside a class, the value is the share [%] of the cell that is not free.
    """
    geometry = evidence.geometry
    free_share, blocked_share, edge_share = shares_of(evidence, resolution)
    cells = np.full(free_share.shape, -1, np.int8)
    cells[edge_share + blocked_share > 1.0 - FREE_SHARE] = EDGE
    blocked = blocked_share > 1.0 - FREE_SHARE
    cells[blocked] = np.round(50 + 50 * blocked_share[blocked]).astype(np.int8)
    navigable = free_share >= FREE_SHARE
    cells[navigable] = np.round(100 * (1.0 - free_share[navigable])).astype(np.int8)
    return GridMap(resolution, geometry.origin_x, geometry.origin_y, cells)


def shares_of(evidence: EvidenceGrid, resolution: float) -> tuple[NDArray[np.floating], ...]:
    """Shares (rows, cols) of each cell of a resolution [m]: free, blocked, an edge far off."""
    count = round(resolution / evidence.geometry.resolution)
    seen = evidence.free_looks + evidence.foot_looks >= ENOUGH
    is_free = evidence.free > evidence.blocked
    # What is only guessed to lie behind an obstacle is not known, whatever was seen from afar.
    blocked = ~is_free & (evidence.foot_looks >= ENOUGH)
    is_free &= seen
    edge = ~is_free & ~blocked & (evidence.foot_looks + evidence.edge_looks >= ENOUGH)
    return _share(is_free, count), _share(blocked, count), _share(edge, count)


def _share(mask: NDArray[np.bool_], count: int) -> NDArray[np.floating]:
    """Share of true cells in each block of count x count."""
    rows, cols = mask.shape[0] // count, mask.shape[1] // count
    whole = mask[: rows * count, : cols * count].astype(np.float32)
    return np.asarray(cv2.resize(whole, (cols, rows), interpolation=cv2.INTER_AREA))
