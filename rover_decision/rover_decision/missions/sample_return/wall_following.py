"""Where to go by sight alone: along the walls, so that everything is passed."""

from __future__ import annotations

import math

import numpy as np

from rover_common.types import PolarArray

LEFT_BIAS = math.radians(10.0)


def wall_follow_a(nav: PolarArray) -> float:
    """Bearing [rad]: half the 85th percentile of the navigable bearings and 0.4 of their mean."""
    bearings = nav.bearings.astype(np.float64)
    return float(0.5 * np.percentile(bearings, 85) + 0.4 * bearings.mean())


def wall_follow_b(nav: PolarArray) -> float:
    """Bearing [rad]: the mean of the navigable bearings with a bias to the left."""
    return mean_bearing(nav) + LEFT_BIAS


def mean_bearing(nav: PolarArray) -> float:
    """[rad]"""
    return float(nav.bearings.astype(np.float64).mean())
