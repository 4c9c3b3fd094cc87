"""What one frame of a mission's video shows."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rover_common.types import GridMap
from rover_tools.report.mission_log import Moment

Image = NDArray[np.uint8]  # (height, width, 3) RGB


@dataclass(frozen=True)
class Video:
    """A mission's video."""

    name: str  # of the file
    seconds: float  # from its begin to the frame that shows the mission's end


def _no_points() -> NDArray[np.float64]:
    return np.empty((0, 2))


@dataclass(frozen=True)
class Snapshot:
    """A mission at one moment; what is None or empty is not drawn."""

    moment: Moment
    samples_total: int
    camera: Image | None = None
    vision: Image | None = None
    grid: GridMap | None = None
    rocks: NDArray[np.float64] = field(default_factory=_no_points)  # (n, 2) [m]
    path: NDArray[np.float64] = field(default_factory=_no_points)  # (n, 2) [m] that is driven now
    score: tuple[float, float] | None = None  # mapped and fidelity [%], where a truth is known
