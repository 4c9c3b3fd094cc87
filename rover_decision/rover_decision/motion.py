"""Commands out of intentions: a speed and a direction, a turn on the spot, a stop."""

from __future__ import annotations

import math

from rover_common.dataflow import Command
from rover_common.vehicle import MAX_STEERING, TURN_IN_PLACE_BELOW

THROTTLE_PER_SPEED = 1.0  # [s/m] throttle per missing speed
BRAKE_PER_SPEED = 0.5  # [s/m] brake per excess speed
SPEED_SLACK = 0.25  # [m/s] of excess without the brake: coasting sheds it gently
COMFORT_DECELERATION = 1.2  # [m/s^2]; full brake gives 2.5
STEERING_PER_BEARING = 0.8
TURN_TOLERANCE = math.radians(4.0)


def drive(speed: float, target_speed: float, bearing: float) -> Command:
    """Drive towards a bearing [rad] with a speed [m/s], both relative to the body."""
    steering = max(-MAX_STEERING, min(MAX_STEERING, STEERING_PER_BEARING * bearing))
    missing = target_speed - speed
    if missing < -SPEED_SLACK:
        return Command(brake=min(1.0, -missing * BRAKE_PER_SPEED), steering_angle=steering)
    return Command(
        throttle=max(0.0, min(1.0, missing * THROTTLE_PER_SPEED)), steering_angle=steering
    )


def reverse(steering: float) -> Command:
    """Back up slowly with this steering angle [rad]."""
    return Command(throttle=-0.4, steering_angle=steering)


def turn_in_place(speed: float, bearing: float) -> Command:
    """Turn on the spot towards a bearing [rad]; it takes a standing rover, and no brake."""
    if abs(speed) >= 0.9 * TURN_IN_PLACE_BELOW:
        return stop()
    if abs(bearing) < TURN_TOLERANCE:
        return Command()
    steering = max(-MAX_STEERING, min(MAX_STEERING, bearing))
    return Command(steering_angle=steering)


def stop() -> Command:
    return Command(brake=1.0)


def approach_speed(distance: float) -> float:
    """The speed [m/s] from which the rover still stops comfortably within `distance` [m]."""
    return math.sqrt(max(0.0, 2.0 * COMFORT_DECELERATION * distance))
