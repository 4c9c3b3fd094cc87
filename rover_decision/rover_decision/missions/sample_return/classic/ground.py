"""Navigable cells as the classic rules count them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.types import PolarArray

CELL = 0.1  # [m] edge of the cells that the documents count: pixels of their top view


@dataclass(frozen=True)
class Ground:
    """Points on navigable ground around the rover."""

    ranges: NDArray[np.float64]  # (n,) [m]
    bearings: NDArray[np.float64]  # (n,) [rad] left positive
    worth: float = 1.0  # of the documents' cells, each point

    @classmethod
    def of(cls, nav: PolarArray, cell: float) -> Ground:
        """cell: [m] edge of the cells that the points stand for."""
        ranges, bearings = nav.ranges.astype(np.float64), nav.bearings.astype(np.float64)
        return cls(ranges, bearings, (cell / CELL) ** 2)

    @property
    def cells(self) -> float:
        """How much ground this is."""
        return self.worth * len(self.ranges)

    def mean_bearing(self, weights: NDArray[np.float64] | None = None) -> float:
        """[rad] weighted by (n,) weights; straight ahead without ground."""
        if len(self.bearings) == 0:
            return 0.0
        return float(np.average(self.bearings, weights=weights))

    def within(self, distance: float) -> Ground:
        """The part that is nearer than a distance [m]."""
        near = self.ranges < distance
        return Ground(self.ranges[near], self.bearings[near], self.worth)

    def sides(self, half_width: float) -> tuple[float, float]:
        """Cells to the left and to the right in a strip ahead of this half width [m]."""
        aside = self.ranges * np.sin(self.bearings)
        left = np.count_nonzero((aside >= 0) & (aside <= half_width))
        right = np.count_nonzero((aside < 0) & (aside >= -half_width))
        return self.worth * left, self.worth * right
