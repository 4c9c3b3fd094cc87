"""The free ground around the robot, as one scan shows it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.types import FreeScan

CANDIDATE_STEP = math.radians(4.0)  # between two directions that are tried


@dataclass(frozen=True)
class LocalClearance:
    """Obstacle points of one scan, and the width that the robot needs."""

    bearings: NDArray[np.floating]  # (n,) [rad] left positive
    ranges: NDArray[np.floating]  # (n,) [m], finite
    corridor: float  # [m] half width

    @classmethod
    def of(cls, scan: FreeScan, corridor: float) -> LocalClearance:
        ranges = np.asarray(np.minimum(scan.ranges, scan.range_max), np.float64)
        bearings = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        return cls(bearings, ranges, corridor)

    def clearance(self, bearing: float) -> float:
        """Free length [m] of the straight corridor in this direction; 0 when nothing is seen."""
        return float(self._clearances(np.array([bearing]))[0])

    def _clearances(self, bearings: NDArray[np.floating]) -> NDArray[np.floating]:
        """The same for many directions (m,) [rad] at once."""
        if len(self.ranges) == 0:
            return np.zeros(len(bearings))
        angle = self.bearings - bearings[:, None]
        ahead = self.ranges * np.cos(angle)
        aside = np.abs(self.ranges * np.sin(angle))
        blocking = (aside < self.corridor) & (ahead > 0)
        nearest = np.where(blocking, ahead, np.inf).min(axis=1)
        return np.minimum(nearest, self.ranges.max())

    def best_bearing(self, wanted: float, length: float) -> float:
        """The bearing closest to the wanted one whose corridor is free for `length` [m].

        Where none is, the one with the longest corridor.
        """
        if len(self.ranges) == 0:
            return wanted
        step = max(1, round(CANDIDATE_STEP / max(1e-3, self._increment())))
        candidates = self.bearings[::step]
        free = self._clearances(candidates)
        is_open = free >= length
        if not is_open.any():
            return float(candidates[np.argmax(free)])
        distance = np.where(is_open, np.abs(candidates - wanted), np.inf)
        return float(candidates[np.argmin(distance)])

    def open_bearing(self, length: float) -> float | None:
        """The bearing nearest to straight ahead that is free for `length` [m], if there is one."""
        bearing = self.best_bearing(0.0, length)
        return bearing if self.clearance(bearing) >= length else None

    def wider_side(self) -> int:
        """+1 where there is more free ground to the left, else -1."""
        left, right = self.ranges[self.bearings > 0], self.ranges[self.bearings < 0]
        return 1 if left.sum() >= right.sum() else -1

    def _increment(self) -> float:
        return float(self.bearings[1] - self.bearings[0]) if len(self.bearings) > 1 else 1.0
