"""The chain map -> odom -> base_footprint over the last seconds, at any stamp within them."""

from __future__ import annotations

from bisect import bisect_left, bisect_right

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, compose, wrap_angle
from rover_common.saved_state import Memory, joined, part_of

KEPT = 10_000_000_000  # [ns]


class Trajectory:
    """Planar poses by stamp, linear in between; the yaw is kept unwrapped for that."""

    def __init__(self) -> None:
        self._stamps: list[int] = []  # [ns]
        self._rows: list[tuple[float, float, float]] = []  # x, y [m], yaw [rad]

    def add(self, stamp: int, pose: Pose) -> None:
        """Append a pose; one that is no newer than the last is ignored."""
        if self._stamps and stamp <= self._stamps[-1]:
            return
        before = self._rows[-1][2] if self._rows else 0.0
        self._stamps.append(stamp)
        self._rows.append((pose.x, pose.y, before + wrap_angle(pose.yaw - before)))
        if self._stamps[0] < stamp - 2 * KEPT:  # seldom, for it moves all that is kept
            first = bisect_left(self._stamps, stamp - KEPT)
            del self._stamps[:first], self._rows[:first]

    def memory(self) -> Memory:
        """All that is kept."""
        rows = np.array(self._rows, float).reshape(-1, 3)
        return {}, {"stamps": np.array(self._stamps, np.int64), "rows": rows}

    def restore(self, memory: Memory) -> None:
        """Take what `memory` gave; raises ValueError or KeyError for anything else."""
        stamps, rows = memory[1]["stamps"], memory[1]["rows"]
        if rows.shape != (*stamps.shape, 3):
            raise ValueError(f"{stamps.shape} stamps of {rows.shape} poses")
        self._stamps, self._rows = stamps.tolist(), [tuple(row) for row in rows.tolist()]

    @property
    def newest(self) -> tuple[int, Pose] | None:
        """The last stamp [ns] and its pose."""
        if not self._stamps:
            return None
        return self._stamps[-1], _pose(self._rows[-1])

    def covers(self, stamp: int) -> bool:
        """Whether a stamp [ns] lies between two poses."""
        return bool(self._stamps) and self._stamps[0] <= stamp <= self._stamps[-1]

    def rows_at(self, stamps: NDArray[np.int64]) -> NDArray[np.float64]:
        """(n, 3) x, y [m], yaw [rad] at ascending stamps (n,) [ns]; the nearest one outside."""
        first = max(0, bisect_right(self._stamps, int(stamps[0])) - 1)
        end = bisect_left(self._stamps, int(stamps[-1])) + 1
        known = self._stamps[first:end]
        at = (np.asarray(stamps) - known[0]).astype(float)
        times = (np.array(known) - known[0]).astype(float)
        rows = np.array(self._rows[first:end])
        return np.stack([np.interp(at, times, column) for column in rows.T], axis=1)

    def at(self, stamp: int) -> Pose:
        """The pose at a stamp [ns]; the nearest one outside."""
        return _pose(self.rows_at(np.array([stamp]))[0])


class PoseBuffer:
    """What tf2's buffer answers, for this one chain."""

    def __init__(self) -> None:
        self.odometry = Trajectory()  # odom -> base_footprint
        self.correction = Trajectory()  # map -> odom

    def memory(self) -> Memory:
        """All that is kept."""
        parts = {"odometry": self.odometry, "correction": self.correction}
        return joined(**{name: part.memory() for name, part in parts.items()})

    def restore(self, memory: Memory) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        self.odometry.restore(part_of(memory, "odometry"))
        self.correction.restore(part_of(memory, "correction"))

    def latest(self) -> Pose | None:
        """The newest pose in the map; None before there is one."""
        newest, correction = self.odometry.newest, self.correction.newest
        if newest is None or correction is None:
            return None
        return compose(correction[1], newest[1])

    def pose_at(self, stamp: int) -> Pose | None:
        """The pose in the map at a stamp [ns]; None outside of what the odometry covers."""
        if self.correction.newest is None or not self.odometry.covers(stamp):
            return None
        return compose(self.correction.at(stamp), self.odometry.at(stamp))


def _pose(row: NDArray[np.float64] | tuple[float, float, float]) -> Pose:
    x, y, yaw = row
    return Pose(float(x), float(y), wrap_angle(float(yaw)))
