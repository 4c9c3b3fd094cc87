"""A velocity as throttle, brake and steering: closed loop on the odometry of each telemetry.

The rover steers like a car, so its curves have a radius of 2.8 m at least while it drives: a
tighter one is driven at full steering. Without a speed it turns in place, 45 degrees a second at
most.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_common.geometry import Pose, wrap_angle
from rover_common.sensor_types import Twist
from rover_common.types import Command
from rover_common.vehicle import ROVER

STANDSTILL = 0.02  # [m/s] a speed below is none
TURN_LEAST = 0.01  # [rad/s] a rate below is none
THROTTLE_PER_SPEED = 3.0  # [s/m] throttle per missing speed
THROTTLE_TO_HOLD = 0.067  # [s/m] throttle per speed, against what the wheels damp on flat ground
THROTTLE_PER_DISTANCE = 1.0  # [1/m] per distance that was missed: holds the speed on a slope
MOST_MISSED = 0.5  # [m] that counts
NEAR_SPEED = 0.2  # [m/s] what is missed counts this near to the speed only
BRAKE_PER_SPEED = 1.0  # [s/m] brake per excess speed
SPEED_SLACK = 0.15  # [m/s] of excess without the brake: the rover coasts
# A rover without throttle and brake that steers slowly begins to turn in place, and stops.
LEAST_THROTTLE = 0.001
STEERING_PER_TURN = 0.6  # steering per angle [rad] that was missed
MOST_TRIM = 0.05  # [rad] of steering for that
TRIM_SPEED = 0.2  # [m/s] from where on the yaw rate says something about the wheels
LONGEST_GAP = 0.5  # [s] between telemetries; after a longer one nothing that was missed counts
TURN_MARGIN = 0.9  # of the speed below which it turns in place


@dataclass
class _Missed:
    """What the loop adds up while the same kind of motion goes on."""

    distance: float = 0.0  # [m] in the direction of travel
    turn: float = 0.0  # [rad] left positive


class VelocityControl:
    """Follows the velocity of one driver, telemetry by telemetry."""

    def __init__(self) -> None:
        self._last: tuple[int, float] | None = None  # [ns] and yaw [rad] of the telemetry before
        self._missed = _Missed()
        self._direction = 0  # of travel

    def command(self, stamp: int, pose: Pose, speed: float, wanted: Twist) -> Command:
        """stamp [ns], pose and speed [m/s, forward positive]: of the telemetry to be answered."""
        elapsed, yaw_rate = self._motion(stamp, pose)
        direction = (wanted.linear > STANDSTILL) - (wanted.linear < -STANDSTILL)
        if direction != self._direction or elapsed > LONGEST_GAP:
            self._direction, self._missed = direction, _Missed()
        if direction == 0:
            return _turn(speed, wanted.angular)
        if direction * speed < -ROVER.standing_speed:
            return Command(brake=1.0)  # it still rolls the other way
        if elapsed <= LONGEST_GAP:
            self._add_up(elapsed, speed, yaw_rate, wanted)
        return self._drive(abs(speed), direction, wanted)

    def _motion(self, stamp: int, pose: Pose) -> tuple[float, float]:
        """Time [s] and mean yaw rate [rad/s] since the telemetry before."""
        before, self._last = self._last, (stamp, pose.yaw)
        if before is None:
            return math.inf, 0.0
        elapsed = (stamp - before[0]) * 1e-9
        # Two telemetries may be of one frame, a nanosecond apart
        return elapsed, wrap_angle(pose.yaw - before[1]) / elapsed if elapsed > 1e-3 else 0.0

    def _add_up(self, elapsed: float, speed: float, yaw_rate: float, wanted: Twist) -> None:
        missing = self._direction * (wanted.linear - speed)
        if abs(missing) >= NEAR_SPEED:
            return
        distance = self._missed.distance + missing * elapsed
        self._missed.distance = max(-MOST_MISSED, min(MOST_MISSED, distance))
        if elapsed > 1e-3 and abs(speed) > TRIM_SPEED:
            turn = self._missed.turn + (wanted.angular - yaw_rate) * elapsed
            limit = MOST_TRIM / STEERING_PER_TURN
            self._missed.turn = max(-limit, min(limit, turn))

    def _drive(self, speed: float, direction: int, wanted: Twist) -> Command:
        """speed: [m/s] in the direction of travel."""
        missing = min(abs(wanted.linear), _top_speed(direction)) - speed
        trim = direction * STEERING_PER_TURN * self._missed.turn
        steering = _clip(_steering(speed, direction, wanted.angular / wanted.linear) + trim)
        if missing < -SPEED_SLACK:
            return Command(brake=min(1.0, -missing * BRAKE_PER_SPEED), steering_angle=steering)
        throttle = THROTTLE_PER_SPEED * missing + THROTTLE_TO_HOLD * speed
        throttle += THROTTLE_PER_DISTANCE * self._missed.distance
        throttle = max(LEAST_THROTTLE, min(1.0, throttle))
        return Command(throttle=direction * throttle, steering_angle=steering)


def _turn(speed: float, rate: float) -> Command:
    """In place, which takes a standing rover and no brake; without a rate [rad/s] the brake."""
    if abs(rate) < TURN_LEAST or abs(speed) >= TURN_MARGIN * ROVER.turn_in_place_below:
        return Command(brake=1.0)
    return Command(steering_angle=_clip(rate / ROVER.turn_in_place_rate))


def _steering(speed: float, direction: int, curvature: float) -> float:
    """For a curve [1/m], left positive, at a speed [m/s]; wheels turn doubly while it backs up."""
    wheel = math.atan(curvature * ROVER.wheelbase / ROVER.yaw_factor)
    if direction < 0:
        wheel /= 2.0
    return _clip(ROVER.max_steering * wheel / ROVER.wheel_limit(speed))


def _top_speed(direction: int) -> float:
    return ROVER.max_speed if direction > 0 else ROVER.max_reverse_speed


def _clip(steering: float) -> float:
    return max(-ROVER.max_steering, min(ROVER.max_steering, steering))
