"""Commands out of intentions: a speed and a bend, a turn on the spot, a stop."""

from __future__ import annotations

import math

from rover_common.types import Command
from rover_common.vehicle import MAX_SPEED, MAX_STEERING, TURN_IN_PLACE_BELOW, WHEELBASE

THROTTLE_PER_SPEED = 3.0  # [s/m] throttle per missing speed
BRAKE_PER_SPEED = 1.0  # [s/m] brake per excess speed
SPEED_SLACK = 0.25  # [m/s] of excess without the brake: coasting sheds it gently
FULL_BRAKE = 2.5  # [m/s^2]
COMFORT_DECELERATION = 1.8  # [m/s^2]
STEERING_PER_BEARING = 0.8
TURN_TOLERANCE = math.radians(4.0)
# The front wheels turn by 15 degrees at rest and by 5 at full speed; the yaw rate is this share of
# the kinematic one.
WHEEL_AT_REST, WHEEL_AT_SPEED = math.radians(15.0), math.radians(5.0)
YAW_FACTOR = 0.95


def drive(speed: float, target_speed: float, bearing: float) -> Command:
    """Drive towards a bearing [rad] with a speed [m/s], both relative to the body."""
    return _at_speed(speed, target_speed, _clip(STEERING_PER_BEARING * bearing))


def drive_curve(speed: float, target_speed: float, curvature: float) -> Command:
    """Drive along a bend [1/m], left positive, with a speed [m/s]."""
    share = min(1.0, abs(speed) / MAX_SPEED)
    limit = WHEEL_AT_REST + share * (WHEEL_AT_SPEED - WHEEL_AT_REST)
    wheel = math.atan(curvature * WHEELBASE / YAW_FACTOR)
    return _at_speed(speed, target_speed, _clip(MAX_STEERING * wheel / limit))


def _at_speed(speed: float, target_speed: float, steering: float) -> Command:
    missing = target_speed - speed
    if missing < -SPEED_SLACK:
        return Command(brake=min(1.0, -missing * BRAKE_PER_SPEED), steering_angle=steering)
    throttle = max(0.0, min(1.0, missing * THROTTLE_PER_SPEED))
    return Command(throttle=throttle, steering_angle=steering)


def reverse(steering: float) -> Command:
    """Back up slowly with this steering angle [rad]."""
    return Command(throttle=-0.4, steering_angle=_clip(steering))


def reverse_towards(bearing: float) -> Command:
    """Back up to a point behind, at this bearing [rad] from the body."""
    behind = math.copysign(math.pi - abs(bearing), bearing)  # off the tail, left side positive
    return reverse(STEERING_PER_BEARING * behind)


def turn_in_place(speed: float, bearing: float) -> Command:
    """Turn on the spot towards a bearing [rad]; it takes a standing rover, and no brake."""
    if abs(speed) >= 0.9 * TURN_IN_PLACE_BELOW:
        return stop()
    if abs(bearing) < TURN_TOLERANCE:
        return Command()
    return Command(steering_angle=_clip(bearing))


def stop() -> Command:
    return Command(brake=1.0)


def approach_speed(distance: float) -> float:
    """The speed [m/s] from which the rover still stops comfortably within `distance` [m]."""
    return math.sqrt(max(0.0, 2.0 * COMFORT_DECELERATION * distance))


def braking_distance(speed: float) -> float:
    """[m] that the rover needs to stop from a speed [m/s] with its full brake."""
    return speed * speed / (2.0 * FULL_BRAKE)


def _clip(steering: float) -> float:
    return max(-MAX_STEERING, min(MAX_STEERING, steering))
