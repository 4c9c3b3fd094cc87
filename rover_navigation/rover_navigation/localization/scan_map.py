"""The map that scans are matched to, and which they make: walls as cells and as lines."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.saved_state import Memory, joined, part_of
from rover_navigation.localization.distance_field import DistanceField
from rover_navigation.localization.log_odds_map import LogOddsMap
from rover_navigation.localization.relocation import (
    all_candidates,
    best_candidate,
    near_candidates,
)
from rover_navigation.localization.scan_matching import Match, match
from rover_navigation.localization.scan_points import ScanPoints
from rover_navigation.localization.wall_lines import LineField, WallLines

# [m] between scans that it has: a lidar that sees all around shows nothing new where it was before,
# and a map that is drawn again and again follows the pose's error.
KEYFRAME_DISTANCE = 0.1
KEYFRAME_SECONDS = 30.0  # [s] after which the world may have changed
INLIER = 0.1  # [m] from a wall of the map
SEARCHED = np.diag([0.05**2, 0.05**2, 0.05**2])  # covariance of a candidate


class ScanMap:
    """Grows with every scan that is added; what is derived from it is made when it is asked for."""

    def __init__(self, resolution: float) -> None:
        """resolution [m]"""
        self.cells = LogOddsMap(resolution)
        self._lines = WallLines(resolution)
        self._fields: tuple[LineField, DistanceField] | None = None
        self._taken = np.empty((0, 3))  # (n, 3) where and when: x, y [m], [s]

    @property
    def begun(self) -> int:
        """[ns] When its first scan was taken; 0 before there is one."""
        return round(self._taken[0, 2] * 1e9) if len(self._taken) else 0

    def memory(self) -> Callable[[], Memory]:
        """A copy; what is called makes a memory of it."""
        cells, lines, taken = self.cells.memory(), self._lines.memory(), self._taken
        return lambda: joined(cells=cells(), lines=lines(), scans=({}, {"taken": taken}))

    def restore(self, memory: Memory) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        self.cells.restore(part_of(memory, "cells"))
        self._lines.restore(part_of(memory, "lines"))
        taken = part_of(memory, "scans")[1]["taken"]
        if taken.ndim != 2 or taken.shape[1] != 3:
            raise ValueError(f"scans of shape {taken.shape}")
        self._taken = taken
        self._fields = None

    def add(self, points: ScanPoints, pose: Pose) -> None:
        """A scan taken at a pose."""
        if len(points.ends) == 0:
            return
        ends, origins = points.placed(pose)
        self.cells.integrate(ends, origins)
        self._lines.add(ends, np.hypot(*(ends - origins).T))
        taken = np.array([[pose.x, pose.y, points.stamp / 1e9]])
        self._taken = np.concatenate([self._taken, taken])
        self._fields = None

    @property
    def has_walls(self) -> bool:
        """Whether scans can be matched to it."""
        return bool(self.cells.walls.any())

    def lacks(self, points: ScanPoints, pose: Pose) -> bool:
        """Whether it has no scan from near a pose, or only old ones."""
        away = np.hypot(self._taken[:, 0] - pose.x, self._taken[:, 1] - pose.y)
        age = points.stamp / 1e9 - self._taken[:, 2]
        return not bool(((away < KEYFRAME_DISTANCE) & (age < KEYFRAME_SECONDS)).any())

    def match(self, points: ScanPoints, predicted: Pose, covariance: NDArray[np.float64]) -> Match:
        """The pose of a scan near to where it is predicted; covariance (3, 3) of that."""
        lines, _ = self._fields_now()
        return match(points.ends, lines, predicted, covariance)

    def search(self, points: ScanPoints, expected: Pose) -> Iterator[Match]:
        """The best pose of a scan around the expected one, then the best one anywhere."""
        yield self._searched_near(points, expected)
        _, field = self._fields_now()
        free = self.cells.known & ~self.cells.walls
        candidates = all_candidates(field, free, expected)
        yield self._searched_near(points, best_candidate(points.ends, field, expected, *candidates))

    def _searched_near(self, points: ScanPoints, expected: Pose) -> Match:
        _, field = self._fields_now()
        candidates = near_candidates(expected)
        start = best_candidate(points.ends, field, expected, *candidates)
        return self.match(points, start, SEARCHED)

    def agreement(self, points: ScanPoints, pose: Pose) -> float:
        """Share of a scan that lies at walls; what lies beyond the known cells says nothing."""
        _, field = self._fields_now()
        ends, _ = points.placed(pose)
        row, col = self.cells.geometry.cell_of(ends[:, 0], ends[:, 1])
        inside = self.cells.geometry.contains(row, col)
        inside[inside] = self.cells.known[row[inside], col[inside]]
        if not inside.any():
            return 0.0
        return float((field.at(*ends[inside].T) < INLIER).mean())

    def _fields_now(self) -> tuple[LineField, DistanceField]:
        if self._fields is None:
            field = DistanceField.of(self.cells.geometry, self.cells.walls)
            self._fields = self._lines.field(), field
        return self._fields
