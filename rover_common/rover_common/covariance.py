"""Covariances, in the order of ROS's messages: x, y, z, then the rotations about these axes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.vehicle import ROVER

AXES = 6
UNMEASURED = 1.0e6  # [m^2], [rad^2] and their rates: so large that a filter ignores the value


@dataclass(frozen=True)
class OdometryCovariance:
    """Both (6, 6); of the pose in the odom frame, and of the twist in that of the body."""

    pose: NDArray[np.float64]  # [m^2, m rad, rad^2]
    twist: NDArray[np.float64]  # [m^2/s^2, m rad/s^2, rad^2/s^2]


@dataclass(frozen=True)
class ImuCovariance:
    """Each (3, 3), about or along x, y and z."""

    orientation: NDArray[np.float64]  # [rad^2]
    angular_velocity: NDArray[np.float64]  # [rad^2/s^2]
    linear_acceleration: NDArray[np.float64]  # [m^2/s^4]


def rounded(step: float) -> float:
    """The variance of a value that is rounded to whole steps."""
    return step**2 / 12.0


def within(limit: float) -> float:
    """The variance of a value of which no more is known than that it is within +- `limit`."""
    return limit**2 / 3.0


# The simulator tells its exact pose, as numbers of four decimals (metres, degrees, m/s).
DECIMALS = 1e-4
ANGLE = rounded(math.radians(DECIMALS))
# Its height it does not tell: what the ground below the wheels rises and falls, chosen.
GROUND = 0.1  # [m]
# [rad/s] of the difference of two yaws, which is the mean over a frame, against the yaw rate at the
# end of that frame. Measured with the simulator's vehicle at 25 frames per second: 0.11 with a
# steering that jumps at random every 0.4 s, 0.006 with one that swings.
YAW_RATE_SIGMA = 0.1

TELEMETRY_COVARIANCE = OdometryCovariance(
    pose=np.diag([rounded(DECIMALS), rounded(DECIMALS), within(GROUND), ANGLE, ANGLE, ANGLE]),
    twist=np.diag(
        [
            within(ROVER.least_reported_speed),  # which is told as 0, far more than the rounding
            UNMEASURED,  # the tyres slip sideways
            UNMEASURED,
            UNMEASURED,
            UNMEASURED,
            YAW_RATE_SIGMA**2,
        ]
    ),
)
