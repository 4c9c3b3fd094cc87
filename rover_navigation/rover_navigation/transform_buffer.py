"""Where the robot was, from the transforms map -> odom and odom -> base_footprint."""

from __future__ import annotations

from bisect import bisect_left

from rover_common.geometry import Pose, compose
from rover_navigation.localization.pose_buffer import KEPT, Trajectory

STALE = 250_000_000  # [ns] that a correction may be older than what it places


class TransformBuffer:
    """What tf2's buffer answers, for this one chain; stamps are [ns].

    Between two odometry messages it interpolates. A correction map -> odom is not interpolated: it
    counts back to the one before it. In between it would be wrong where the odometry is far from
    its origin, for there a small turn of the frame is a long way.
    """

    def __init__(self) -> None:
        self._odometry = Trajectory()  # odom -> base_footprint
        self._stamps: list[int] = []  # of the corrections
        self._corrections: list[Pose] = []  # map -> odom

    def add_odometry(self, stamp: int, pose: Pose) -> None:
        """odom -> base_footprint."""
        self._odometry.add(stamp, pose)

    def add_correction(self, stamp: int, pose: Pose) -> None:
        """map -> odom; one that is no newer than the last is ignored."""
        if self._stamps and stamp <= self._stamps[-1]:
            return
        self._stamps.append(stamp)
        self._corrections.append(pose)
        if self._stamps[0] < stamp - 2 * KEPT:
            first = bisect_left(self._stamps, stamp - KEPT)
            del self._stamps[:first], self._corrections[:first]

    @property
    def newest_odometry(self) -> int:
        """The stamp of odom -> base_footprint; 0 before there is one."""
        newest = self._odometry.newest
        return 0 if newest is None else newest[0]

    @property
    def newest_correction(self) -> int:
        """The stamp of map -> odom; 0 before there is one."""
        return self._stamps[-1] if self._stamps else 0

    def latest(self) -> tuple[int, Pose] | None:
        """The newest pose in the map, and the stamp of the older one of its two transforms."""
        newest = self._odometry.newest
        if newest is None or not self._stamps:
            return None
        stamp, pose = newest
        return min(stamp, self._stamps[-1]), compose(self._corrections[-1], pose)

    def pose_at(self, stamp: int) -> Pose | None:
        """The pose in the map at a stamp; None where the transforms do not tell it."""
        if not self._odometry.covers(stamp) or not self._stamps:
            return None
        if stamp > self._stamps[-1] + STALE:
            return None
        index = min(bisect_left(self._stamps, stamp), len(self._stamps) - 1)
        return compose(self._corrections[index], self._odometry.at(stamp))
