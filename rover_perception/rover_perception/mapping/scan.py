"""Free distance per bearing, from how far the ground reaches in each column."""

from __future__ import annotations

import math

import numpy as np

from rover_common.types import FreeScan
from rover_perception.camera.ground_projection import View
from rover_perception.camera.segmentation import Columns

FIELD = math.radians(54.0)  # [rad] to either side
INCREMENT = math.radians(1.0)  # [rad]; the camera has at least two columns in each
COUNT = round(2 * FIELD / INCREMENT) + 1
RANGE_MIN = 0.75  # [m] from base_link; the camera sees no nearer


def free_scan(view: View, columns: Columns, max_range: float) -> FreeScan:
    """The nearest end of the ground in each degree of bearing; inf where the ground goes on."""
    u = np.arange(len(columns.reach)) + 0.5
    x, y = view.ground(u, columns.reach)
    ranges = np.hypot(x, y)
    bearings = np.arctan2(y, x)
    ranges = np.where(columns.blocked | (ranges < max_range), ranges, np.inf)
    index = np.round((bearings + FIELD) / INCREMENT).astype(int)
    inside = (index >= 0) & (index < COUNT) & np.isfinite(ranges)
    nearest = np.full(COUNT, np.inf)
    np.minimum.at(nearest, index[inside], ranges[inside])
    nearest = np.where(nearest > max_range, np.inf, np.maximum(nearest, RANGE_MIN))
    return FreeScan(-FIELD, INCREMENT, RANGE_MIN, max_range, nearest.astype(np.float32))


def no_scan(max_range: float) -> FreeScan:
    """What a frame without usable ground says: nothing is free."""
    return FreeScan(-FIELD, INCREMENT, RANGE_MIN, max_range, np.full(COUNT, RANGE_MIN, np.float32))
