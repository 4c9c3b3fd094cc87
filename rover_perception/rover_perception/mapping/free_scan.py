"""Free distance per bearing, from how far the ground extends in each column of the image."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.types import FreeScan
from rover_perception.camera.ground_projection import GroundProjection
from rover_perception.camera.segmentation import GroundColumns

FIELD = math.radians(54.0)  # [rad] to either side; the camera sees 54.5 degrees at its centre row
INCREMENT = math.radians(1.0)  # [rad]; at least two columns of the image fall into each
COUNT = round(2 * FIELD / INCREMENT) + 1
RANGE_MIN = 0.75  # [m] from base_link: the nearest ground in the image of a level rover


def free_scan(projection: GroundProjection, columns: GroundColumns, max_range: float) -> FreeScan:
    """The nearest end of the ground in each degree of bearing; inf where it is beyond max_range."""
    u = np.arange(len(columns.reach)) + 0.5
    x, y = projection.ground(u, columns.reach)
    ranges = np.hypot(x, y)
    bearings = np.arctan2(y, x)
    ranges = np.where(columns.blocked | (ranges < max_range), ranges, np.inf)
    index = np.round((bearings + FIELD) / INCREMENT).astype(int)
    inside = (index >= 0) & (index < COUNT) & np.isfinite(ranges)
    nearest = np.full(COUNT, np.inf)
    np.minimum.at(nearest, index[inside], ranges[inside])
    return scan_of(nearest, max_range)


def scan_of(nearest: NDArray, max_range: float) -> FreeScan:
    """The scan of the distances [m] to the nearest obstacle in each of COUNT bearings."""
    ranges = np.where(nearest > max_range, np.inf, np.maximum(nearest, RANGE_MIN))
    return FreeScan(-FIELD, INCREMENT, RANGE_MIN, max_range, ranges.astype(np.float32))


def blocked_scan(max_range: float) -> FreeScan:
    """The scan of a frame without usable ground: blocked at RANGE_MIN in every direction."""
    return FreeScan(-FIELD, INCREMENT, RANGE_MIN, max_range, np.full(COUNT, RANGE_MIN, np.float32))
