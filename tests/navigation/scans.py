"""Scans by hand."""

from __future__ import annotations

import math

import numpy as np

from rover_common.types import FreeScan

RANGE = 12.0  # [m]
BEARINGS = np.radians(np.arange(-54, 55))


def scan_of(ranges: np.ndarray) -> FreeScan:
    """Of free lengths (109,) [m], from the right to the left."""
    angle_min, step = float(BEARINGS[0]), math.radians(1)
    return FreeScan(angle_min, step, 0.75, RANGE, np.asarray(ranges, np.float32))


def open_scan(ahead: float = RANGE) -> FreeScan:
    """Free ground for so many metres in every direction."""
    return scan_of(np.full(len(BEARINGS), ahead))
