"""A rolling scan as points of one moment."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.sensor_types import LaserScan
from rover_navigation.localization.pose_buffer import Trajectory


@dataclass(frozen=True)
class ScanPoints:
    """What came back of one turn, in base_footprint as it stood at the last ray."""

    stamp: int  # [ns] of the last ray
    ends: NDArray[np.float64]  # (n, 2) [m]
    origins: NDArray[np.float64]  # (n, 2) [m] where the lidar was for each

    def placed(self, pose: Pose) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Ends and origins in the frame in which base_footprint has this pose."""
        return transformed(self.ends, pose), transformed(self.origins, pose)


def last_ray(scan: LaserScan) -> int:
    """[ns] The stamp of a scan's last ray."""
    return scan.stamp + round(max(0, len(scan.ranges) - 1) * scan.time_increment * 1e9)


def deskew(scan: LaserScan, odometry: Trajectory, lidar_x: float) -> ScanPoints:
    """The rays that came back, each from where the robot was when it was taken.

    At 1.8 rad/s the first and the last ray of a turn of 0.1 s differ by 10 degrees.
    lidar_x: [m] of base_scan in base_footprint.
    """
    ranges = np.asarray(scan.ranges, float)
    limit = min(scan.range_max, float(np.finfo(np.float32).max))
    back = np.flatnonzero((ranges > 0.0) & (ranges >= scan.range_min) & (ranges <= limit))
    stamp = last_ray(scan)
    if len(back) == 0:
        return ScanPoints(stamp, np.empty((0, 2)), np.empty((0, 2)))
    angles = scan.angle_min + scan.angle_increment * back
    taken = scan.stamp + np.round(back * (scan.time_increment * 1e9)).astype(np.int64)
    away = ranges[back, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    origin = np.array([[lidar_x, 0.0]])
    rows = odometry.rows_at(np.append(taken, stamp))
    moved = _relative(rows[:-1], rows[-1])
    return ScanPoints(stamp, _carried(away + origin, moved), _carried(origin, moved))


def transformed(points: NDArray[np.float64], pose: Pose) -> NDArray[np.float64]:
    """Points (n, 2) [m] given in the frame of a pose, in the frame of that pose itself."""
    return _carried(points, np.array([[pose.x, pose.y, pose.yaw]]))


def _relative(rows: NDArray[np.float64], base: NDArray[np.float64]) -> NDArray[np.float64]:
    """Poses (n, 3) as seen from the pose `base` (3,)."""
    cos, sin = np.cos(base[2]), np.sin(base[2])
    x, y, yaw = (rows - base).T
    return np.stack([cos * x + sin * y, cos * y - sin * x, yaw], axis=1)


def _carried(points: NDArray[np.float64], rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (n, 2) or (1, 2), each given in the frame of its pose (n, 3), in the poses' frame."""
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    x, y = points[:, 0], points[:, 1]
    return np.stack([rows[:, 0] + cos * x - sin * y, rows[:, 1] + sin * x + cos * y], axis=1)
