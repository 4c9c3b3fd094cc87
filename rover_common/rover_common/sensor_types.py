"""What the second robot's sensors say, and what its wheels are told.

Every type is frozen; stamps are integers [ns] of the ROS clock; SI and REP-103.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose


@dataclass(frozen=True)
class Twist:
    """Velocity of base_footprint."""

    linear: float = 0.0  # [m/s] forward positive
    angular: float = 0.0  # [rad/s] left positive


@dataclass(frozen=True)
class LaserScan:
    """One turn of the lidar, in base_scan; the rays are taken one after the other."""

    stamp: int  # [ns] of the first ray
    angle_min: float  # [rad] of the first ray
    angle_increment: float  # [rad] between rays, left positive
    time_increment: float  # [s] between rays
    range_min: float  # [m] nothing nearer is measured
    range_max: float  # [m]
    ranges: NDArray[np.float32]  # (n,) [m]; 0, nan and infinities where nothing came back


@dataclass(frozen=True)
class Imu:
    """One sample of the inertial measurement unit, in imu_link, which is parallel to base_link."""

    stamp: int  # [ns]
    orientation: tuple[float, float, float, float] | None  # x, y, z, w; None where not measured
    angular_velocity: tuple[float, float, float]  # [rad/s]
    linear_acceleration: tuple[float, float, float]  # [m/s^2], upwards 9.8 at rest


@dataclass(frozen=True)
class WheelOdometry:
    """Dead reckoning from wheel turns and gyro."""

    stamp: int  # [ns]
    pose: Pose  # of base_footprint in the odom frame
    twist: Twist


@dataclass(frozen=True)
class ThermalFrame:
    """One picture of a thermal sensor."""

    stamp: int  # [ns] when it arrived; it was taken before
    sensor: int  # 1 or 2
    celsius: NDArray[np.float32]  # (8, 8) [C], row 0 on top, column 0 on the left


@dataclass(frozen=True)
class SensorBatch:
    """What all sensors said since the batch before, each in the order of its stamps."""

    stamp: int  # [ns] of the batch; none of its contents is newer
    scans: tuple[LaserScan, ...] = ()
    imus: tuple[Imu, ...] = ()
    odometry: tuple[WheelOdometry, ...] = ()
    thermal: tuple[ThermalFrame, ...] = ()
    launches_done: int = 0  # sequences that the launcher has reported as finished
