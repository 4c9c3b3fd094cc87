"""The rover's body: the measured planar model at 50 Hz, with the tilt that goes with it.

Sources: the simulator's constants for masses, torques and limits; recordings for the rest.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from rover_common.geometry import Pose, wrap_angle
from rover_common.vehicle import ROVER
from rover_simulator.vehicle.ground import Ground
from rover_simulator.vehicle.tilt import Swing, Tilt

STEP = 0.02  # [s]
GRAVITY = 9.81  # [m/s^2]
DRIVE = 0.852  # [m/s^2] per unit of throttle: 4 wheels x 25 N m / 0.1485 m over 790 kg
COAST = 0.0574  # [1/s] wheel damping
# Brake input and the deceleration [m/s^2] that it gives; the wheels lock beyond 3.
BRAKE_INPUT = (0.0, 0.83, 1.0, 2.0, 5.0)
BRAKE_DECELERATION = (0.0, ROVER.full_brake_deceleration, ROVER.full_brake_deceleration, 4.2, 7.0)
YAW_COASTING, YAW_DRIVEN = 0.92, 0.96  # of the kinematic yaw rate
# Deceleration per sideways acceleration; measured at full steering: 0.03 m/s^2 at 1.75 m/s,
# 0.06 at 2.75 and 0.13 at 3.75, where the rover is pushed sideways with 0.8, 1.6 and 2.4 m/s^2.
CORNERING = 0.04
# The tyres give way sideways, so that the course swings from inside of the yaw at low speed to
# outside of it at high: 4 degrees at 2 m/s and full steering, none at 3.7, -1.4 at 5.
SIDE_GIVE = math.radians(1.15)  # [rad s^2/m] of course per sideways acceleration
# The yaw rate follows the wheels only after the tyres have rolled on.
YAW_DELAY = 0.006  # [s^2/m] time constant per speed: 0.03 s at 5 m/s
SIDE_SLIP = 0.3  # [s] sideways speed per sideways component of gravity beyond what tyres hold
SIDE_HOLD = 0.6  # sideways slope that the tyres hold


@dataclass(frozen=True)
class Controls:
    """What the simulator holds of the last command."""

    steering: float = 0.0  # [rad] left positive
    throttle: float = 0.0  # not clamped
    brake: float = 0.0  # not clamped


class Vehicle:
    """State of the body; `step` moves it by one physics step."""

    def __init__(self, start: Pose) -> None:
        self.pose = start
        self.speed = 0.0  # [m/s] along the body, forward positive
        self._turning = False  # on the spot
        self._yaw_rate = 0.0  # [rad/s]
        self._tilt = Tilt(Swing(start.pitch), Swing(start.roll))

    @property
    def reported_speed(self) -> float:
        return 0.0 if abs(self.speed) < ROVER.least_reported_speed else self.speed

    def halt(self) -> None:
        """Freeze the body, as the arm's sequence does."""
        self.speed = 0.0
        self._turning = False
        self._yaw_rate = 0.0

    def roll_on(self, speed: float, controls: Controls) -> None:
        """Go on as if it had driven at this speed [m/s] under these controls for a while."""
        self.speed = speed
        self._yaw_rate = self._steady_yaw_rate(controls)

    def bump(self, before: Pose) -> None:
        """Stand still where it was before it ran into something."""
        pose = self.pose
        self.pose = Pose(before.x, before.y, before.yaw, pose.pitch, pose.roll)
        self.speed = 0.0
        self._yaw_rate = 0.0

    def rotate(self, angle: float) -> None:
        """Turn the held body by an angle [rad], as a fixed turn does."""
        self.pose = replace(self.pose, yaw=wrap_angle(self.pose.yaw + angle))

    def step(self, controls: Controls, ground: Ground) -> None:
        """One step of 0.02 s."""
        motor = controls.throttle != 0.0 or controls.brake != 0.0
        slow = abs(self.speed) < ROVER.turn_in_place_below
        self._turning = not motor and controls.steering != 0.0 and (self._turning or slow)
        before = self.speed
        if self._turning:
            self.speed = 0.0
            self._yaw_rate = 0.0
            self._move(0.0, ROVER.turn_in_place_rate * controls.steering, 0.0, ground)
            self._lean(0.0, 0.0, ground)
            return
        steady = self._steady_yaw_rate(controls)
        self._yaw_rate += (steady - self._yaw_rate) * STEP / (STEP + YAW_DELAY * abs(self.speed))
        rate = self._yaw_rate
        self._accelerate(controls, rate, ground)
        inside = math.atan(
            ROVER.rear_axle * math.tan(self._wheel_angle(controls)) / ROVER.wheelbase
        )
        self._move(self.speed, rate, inside - SIDE_GIVE * abs(self.speed) * rate, ground)
        drive = DRIVE * controls.throttle if self.speed < ROVER.max_speed - 0.01 else DRIVE
        braking = (before - self.speed) / STEP if controls.brake else 0.0
        self._lean(drive * bool(controls.throttle) - braking, self.speed * rate, ground)

    def _steady_yaw_rate(self, controls: Controls) -> float:
        """Yaw rate [rad/s] of a long turn at this speed: a part of what the wheels' angle gives."""
        factor = YAW_DRIVEN if controls.throttle else YAW_COASTING
        return factor * self.speed * math.tan(self._wheel_angle(controls)) / ROVER.wheelbase

    def _wheel_angle(self, controls: Controls) -> float:
        """Front wheels [rad]: less at speed, doubled in reverse."""
        double = 2.0 if controls.throttle < 0 else 1.0
        return double * ROVER.wheel_limit(self.speed) * controls.steering / ROVER.max_steering

    def _accelerate(self, controls: Controls, rate: float, ground: Ground) -> None:
        push = DRIVE * controls.throttle - COAST * self.speed - GRAVITY * ground.ahead
        self.speed += push * STEP
        brake = _interpolate(abs(controls.brake), BRAKE_INPUT, BRAKE_DECELERATION)
        loss = (brake + CORNERING * abs(rate) * abs(self.speed)) * STEP
        self.speed = math.copysign(max(0.0, abs(self.speed) - loss), self.speed)
        limit = ROVER.max_reverse_speed if controls.throttle < 0 else ROVER.max_speed
        self.speed = max(-limit, min(limit, self.speed))

    def _move(self, speed: float, rate: float, slip: float, ground: Ground) -> None:
        pose = self.pose
        yaw = wrap_angle(pose.yaw + rate * STEP)
        course = yaw + slip
        excess = math.copysign(max(0.0, abs(ground.aside) - SIDE_HOLD), ground.aside)
        slide = -SIDE_SLIP * GRAVITY * excess
        x = pose.x + (speed * math.cos(course) - slide * math.sin(yaw)) * STEP
        y = pose.y + (speed * math.sin(course) + slide * math.cos(yaw)) * STEP
        self.pose = Pose(x, y, yaw, pose.pitch, pose.roll)

    def _lean(self, forward: float, leftward: float, ground: Ground) -> None:
        """Tilt with the ground and with the forces per mass [m/s^2]."""
        self._tilt = self._tilt.step(ground, forward, leftward, STEP)
        pose = self.pose
        self.pose = Pose(pose.x, pose.y, pose.yaw, self._tilt.pitch.angle, self._tilt.roll.angle)


def _interpolate(x: float, xs: tuple[float, ...], ys: tuple[float, ...]) -> float:
    for x0, x1, y0, y1 in zip(xs, xs[1:], ys, ys[1:], strict=False):
        if x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return ys[-1]
