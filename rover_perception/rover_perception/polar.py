"""Points of the level frame as polar arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_common.types import PolarArray


def polar_array(x: NDArray, y: NDArray) -> PolarArray:
    """Points (x, y) [m] of the level frame by range and bearing."""
    return PolarArray(
        np.hypot(x, y).astype(np.float32),
        np.arctan2(y, x).astype(np.float32),
    )
