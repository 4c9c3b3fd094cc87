"""What the lidar met, in the map frame, for the last moments."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray

from rover_common.burger import BURGER
from rover_common.sensor_types import LaserScan
from rover_heat.types import PoseSource
from rover_navigation.localization.pose_buffer import Trajectory
from rover_navigation.localization.scan_points import deskew, last_ray
from rover_navigation.types import NO_POINTS

KEPT = 12  # scans: more than a second of them
TOGETHER = 3  # scans
NEAR = 500_000_000  # [ns] from a thermal frame to a scan that serves it

Points = NDArray[np.float64]


class ScanHits:
    """The newest scans; one is placed when its pose is known."""

    def __init__(self) -> None:
        self._waiting: deque[LaserScan] = deque(maxlen=3)
        self._hits: deque[tuple[int, Points]] = deque(maxlen=KEPT)

    @property
    def newest(self) -> Points:
        """(n, 2) [m]"""
        return self._hits[-1][1] if self._hits else NO_POINTS

    def update(self, scans: tuple[LaserScan, ...], poses: PoseSource) -> None:
        """What has come since the last tick; a scan waits for the pose of its last ray."""
        self._waiting.extend(scans)
        while self._waiting:
            hits = _placed(self._waiting[0], poses)
            if hits is None:
                return
            self._hits.append((last_ray(self._waiting.popleft()), hits))

    def near(self, stamp: int) -> Points:
        """(n, 2) [m] Of the scans that ended nearest to a stamp [ns]; none when that is too long.

        Some of them together: one turn alone has four rays for the width of a pixel.
        """
        order = sorted(self._hits, key=lambda hit: abs(hit[0] - stamp))
        hits = [hit for at, hit in order[:TOGETHER] if abs(at - stamp) <= NEAR]
        return np.concatenate(hits) if hits else NO_POINTS


def _placed(scan: LaserScan, poses: PoseSource) -> Points | None:
    """(n, 2) [m]; None where the poses do not reach yet."""
    last = last_ray(scan)
    end = poses.pose_at(last)
    if end is None:
        return None
    trajectory = Trajectory()
    for stamp in (scan.stamp, (scan.stamp + last) // 2):
        pose = poses.pose_at(stamp)
        if pose is not None:
            trajectory.add(stamp, pose)
    trajectory.add(last, end)
    return deskew(scan, trajectory, BURGER.lidar_x).placed(end)[0]
