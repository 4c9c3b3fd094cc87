"""The inertial unit: gyro, accelerometer, and the attitude that the board makes of both.

The board's filter is Madgwick's without the magnetometer: yaw is the integral of the gyro, so it
drifts with its bias; pitch and roll follow the gyro and are drawn towards the accelerometer's
direction with a constant rate, so that accelerations of the robot show in them for a while.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.random import Generator

from burger_simulator.model.physics import Physics
from burger_simulator.world.maze import SensorErrors
from rover_common.geometry import Pose, quaternion_from_pose
from rover_common.sensor_types import Imu

PERIOD = 0.01  # [s]
GYRO_SIGMA = 2.0e-4  # [rad/s] by the maker's model file
ACCELEROMETER_SIGMA = 0.017  # [m/s^2]
PULL = 0.2  # [rad/s] twice the filter's beta in the board's firmware


class InertialUnit:
    """Its yaw is 0 when it is switched on."""

    def __init__(self, physics: Physics, errors: SensorErrors, random: Generator) -> None:
        self._physics, self._random = physics, random
        self._bias = np.array(errors.gyro_bias)
        self.yaw = 0.0  # [rad] not wrapped
        self._roll, self._pitch = _tilt_of(*physics.accelerometer.tolist())

    def measure(self, stamp: int) -> Imu:
        """Once in each PERIOD."""
        noise = self._random.standard_normal(6)
        gyro = (self._physics.gyro + self._bias + GYRO_SIGMA * noise[:3]).tolist()
        acceleration = (self._physics.accelerometer + ACCELEROMETER_SIGMA * noise[3:]).tolist()
        self._filter(gyro, *_tilt_of(*acceleration))
        return Imu(
            stamp=stamp,
            orientation=quaternion_from_pose(Pose(0.0, 0.0, self.yaw, self._pitch, self._roll)),
            angular_velocity=tuple(gyro),
            linear_acceleration=tuple(acceleration),
        )

    def _filter(self, gyro: list[float], roll: float, pitch: float) -> None:
        """From the gyro's rates [rad/s] and the accelerometer's tilt [rad]."""
        x, y, z = gyro
        sin, cos = math.sin(self._roll), math.cos(self._roll)
        across = sin * y + cos * z
        self.yaw += PERIOD * across / math.cos(self._pitch)
        self._roll += PERIOD * (x + across * math.tan(self._pitch))
        self._pitch += PERIOD * (cos * y - sin * z)
        roll, pitch = roll - self._roll, pitch - self._pitch
        share = min(1.0, PULL * PERIOD / max(math.hypot(roll, pitch), 1e-12))
        self._roll += share * roll
        self._pitch += share * pitch


def _tilt_of(x: float, y: float, z: float) -> tuple[float, float]:
    """Roll and pitch [rad] of a body at rest that measures this acceleration [m/s^2]."""
    return math.atan2(y, z), math.atan2(-x, math.hypot(y, z))
