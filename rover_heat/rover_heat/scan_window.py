"""What one scan shows in a direction."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.sensor_types import LaserScan


def ranges_around(scan: LaserScan | None, bearing: float, window: float) -> NDArray[np.float64]:
    """(n,) [m] Within a window [rad] around a bearing [rad] of base_scan; inf for nothing."""
    nothing = np.array([math.inf])
    if scan is None:
        return nothing
    ranges = np.asarray(scan.ranges, float)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges)) - bearing
    aside = np.abs((angles + math.pi) % (2.0 * math.pi) - math.pi)
    met = ranges[np.isfinite(ranges) & (ranges >= scan.range_min) & (aside <= window)]
    return met if len(met) else nothing
