"""Commands of a car-like robot out of intentions: a speed and a curve, a turn in place, a stop."""

from __future__ import annotations

import math

from rover_common.types import Command
from rover_common.vehicle import VehicleModel

THROTTLE_PER_SPEED = 3.0  # [s/m] throttle per missing speed
BRAKE_PER_SPEED = 1.0  # [s/m] brake per excess speed
SPEED_SLACK = 0.25  # [m/s] of excess without the brake: coasting sheds it gently
COMFORT_DECELERATION = 1.8  # [m/s^2]
REVERSE_THROTTLE = -0.4
STEERING_PER_BEARING = 0.8
TURN_TOLERANCE = math.radians(4.0)
TURN_MARGIN = 0.9  # of the speed below which the vehicle turns in place


class Actuation:
    """What one vehicle has to be told; all speeds, bearings and curvatures in its body frame."""

    def __init__(self, vehicle: VehicleModel) -> None:
        self.vehicle = vehicle

    def drive(self, speed: float, target_speed: float, bearing: float) -> Command:
        """Drive towards a bearing [rad] with a speed [m/s]."""
        return self._at_speed(speed, target_speed, STEERING_PER_BEARING * bearing)

    def drive_curve(self, speed: float, target_speed: float, curvature: float) -> Command:
        """Drive along a curve [1/m], left positive, with a speed [m/s]."""
        model = self.vehicle
        wheel = math.atan(curvature * model.wheelbase / model.yaw_factor)
        steering = model.max_steering * wheel / model.wheel_limit(speed)
        return self._at_speed(speed, target_speed, steering)

    def _at_speed(self, speed: float, target_speed: float, steering: float) -> Command:
        steering = self._clip(steering)
        missing = target_speed - speed
        if missing < -SPEED_SLACK:
            return Command(brake=min(1.0, -missing * BRAKE_PER_SPEED), steering_angle=steering)
        throttle = max(0.0, min(1.0, missing * THROTTLE_PER_SPEED))
        return Command(throttle=throttle, steering_angle=steering)

    def reverse(self, steering: float = 0.0) -> Command:
        """Back up slowly with this steering angle [rad]."""
        return Command(throttle=REVERSE_THROTTLE, steering_angle=self._clip(steering))

    def reverse_towards(self, bearing: float) -> Command:
        """Back up to a point behind, at this bearing [rad]."""
        behind = math.copysign(math.pi - abs(bearing), bearing)  # off the tail, left positive
        return self.reverse(STEERING_PER_BEARING * behind)

    def turn_in_place(self, speed: float, bearing: float) -> Command:
        """Turn in place towards a bearing [rad]; it takes a standing vehicle, and no brake."""
        if abs(speed) >= TURN_MARGIN * self.vehicle.turn_in_place_below:
            return self.stop()
        if abs(bearing) < TURN_TOLERANCE:
            return Command()
        return Command(steering_angle=self._clip(bearing))

    def stop(self) -> Command:
        """The full brake."""
        return Command(brake=1.0)

    def braking_distance(self, speed: float) -> float:
        """[m] needed to stop from a speed [m/s] with the full brake."""
        return speed * speed / (2.0 * self.vehicle.full_brake_deceleration)

    def _clip(self, steering: float) -> float:
        limit = self.vehicle.max_steering
        return max(-limit, min(limit, steering))


def approach_speed(distance: float) -> float:
    """The speed [m/s] from which a robot still stops comfortably within `distance` [m]."""
    return math.sqrt(max(0.0, 2.0 * COMFORT_DECELERATION * distance))
