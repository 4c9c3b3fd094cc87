"""How accurate odometry and inertial unit are, by the errors that are drawn for each robot.

Two errors are constant in a robot and make its odometry drift: its wheels are by a share larger
than nominal, and its gyro has a bias. To first order the pose's error is the sum of both, each
times what it has added up to on the path so far.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burger_simulator.sensors.imu import ACCELEROMETER_SIGMA, GYRO_SIGMA, PERIOD
from burger_simulator.sensors.odometry import RATE
from burger_simulator.world.generator import GYRO_BIAS, LEVEL_BIAS, WHEEL_RADIUS
from rover_common.covariance import AXES, UNMEASURED, ImuCovariance, OdometryCovariance, within
from rover_common.sensor_types import WheelOdometry

SCALE = within(WHEEL_RADIUS)  # variance of the wheels' true radius over the nominal one
BIAS = GYRO_BIAS**2  # [rad^2/s^2]
NOISE = GYRO_SIGMA**2 * PERIOD  # [rad^2/s] that the gyro's noise adds to the yaw
ATTITUDE = within(0.052)  # [rad^2] roll and pitch of the unit against the ground, measured
MOTIONLESS = 1.0e-6  # [m^2], [m^2/s^2]: below what the encoders tell
GRAVITY = 9.81  # [m/s^2]
X, Y, Z, ROLL, PITCH, YAW = range(AXES)


class OdometryAccuracy:
    """Follows the odometry from where it began."""

    def __init__(self) -> None:
        self._first: WheelOdometry | None = None
        self._last: WheelOdometry | None = None
        self._by_bias = np.zeros(2)  # [m s] x and y that a bias of 1 rad/s adds up to

    def follow(self, odometry: WheelOdometry) -> OdometryCovariance:
        """The covariance of a message, in their order."""
        first = self._first = self._first or odometry
        last = self._last or odometry
        seconds = (odometry.stamp - first.stamp) * 1e-9
        before, pose = last.pose, odometry.pose
        self._by_bias += seconds * np.array([before.y - pose.y, pose.x - before.x])
        self._last = odometry
        driven = np.array([pose.x - first.pose.x, pose.y - first.pose.y])
        return OdometryCovariance(self._of_pose(driven, seconds), _of_twist(odometry))

    def _of_pose(self, driven: NDArray[np.float64], seconds: float) -> NDArray[np.float64]:
        """`driven` (2,) [m] from where it began, so many seconds ago."""
        covariance = np.diag([MOTIONLESS] * 3 + [ATTITUDE, ATTITUDE, NOISE * seconds])
        by_bias = np.array([*self._by_bias, seconds])  # x, y, yaw
        planar = np.ix_([X, Y, YAW], [X, Y, YAW])
        covariance[planar] += BIAS * np.outer(by_bias, by_bias)
        covariance[np.ix_([X, Y], [X, Y])] += SCALE * np.outer(driven, driven)
        return covariance


def imu_covariance(seconds: float) -> ImuCovariance:
    """So many seconds after the unit was switched on; its yaw is 0 then, and drifts."""
    gyro = GYRO_SIGMA**2 + BIAS
    level = ACCELEROMETER_SIGMA**2 + (GRAVITY * LEVEL_BIAS) ** 2
    return ImuCovariance(
        orientation=np.diag([ATTITUDE, ATTITUDE, BIAS * seconds**2 + NOISE * seconds]),
        angular_velocity=np.diag([gyro, gyro, gyro]),
        linear_acceleration=np.diag([level, level, ACCELEROMETER_SIGMA**2]),
    )


def _of_twist(odometry: WheelOdometry) -> NDArray[np.float64]:
    speed = MOTIONLESS + SCALE * odometry.twist.linear**2
    turn = BIAS + NOISE * RATE
    return np.diag([speed, MOTIONLESS, UNMEASURED, UNMEASURED, UNMEASURED, turn])
