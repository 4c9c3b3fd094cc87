"""Wheel odometry as the board makes it: path from the wheels' turns, heading from the gyro."""

from __future__ import annotations

import math

from burger_simulator.model.physics import Physics
from burger_simulator.sensors.imu import InertialUnit
from rover_common.burger import BURGER
from rover_common.geometry import Pose, wrap_angle
from rover_common.sensor_types import Twist, WheelOdometry

RATE = 30  # [1/s]
DECIMALS = 9  # of a heading, which its message keeps for certain


class Odometer:
    """Knows the nominal radius of the wheels only."""

    def __init__(self, physics: Physics, imu: InertialUnit, stamp: int, x: float) -> None:
        """Begins at `x` [m], with the heading 0, at `stamp` [ns]."""
        self._physics, self._imu = physics, imu
        self._angles, self._yaw, self._stamp = physics.wheel_angles, imu.yaw, stamp
        self._start_yaw = imu.yaw
        self._x, self._y = x, 0.0

    def measure(self, stamp: int) -> WheelOdometry:
        left, right = self._physics.wheel_angles
        turned = (left - self._angles[0] + right - self._angles[1]) / 2
        path = BURGER.wheel_radius * turned
        yaw = self._imu.yaw
        heading = (self._yaw + yaw) / 2 - self._start_yaw
        self._x += path * math.cos(heading)
        self._y += path * math.sin(heading)
        seconds = (stamp - self._stamp) / 1e9
        twist = Twist(path / seconds, (yaw - self._yaw) / seconds)
        self._angles, self._yaw, self._stamp = (left, right), yaw, stamp
        heading = round(wrap_angle(yaw - self._start_yaw), DECIMALS)
        return WheelOdometry(stamp, Pose(self._x, self._y, heading), twist)


def wheel_speeds(twist: Twist) -> tuple[float, float]:
    """[rad/s] left and right, by the nominal distance and radius of the wheels, within limits."""
    linear = max(-BURGER.speed_max, min(BURGER.speed_max, twist.linear))
    angular = max(-BURGER.turn_max, min(BURGER.turn_max, twist.angular))
    aside = angular * BURGER.wheel_separation / 2
    return (linear - aside) / BURGER.wheel_radius, (linear + aside) / BURGER.wheel_radius
