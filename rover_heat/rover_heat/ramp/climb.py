"""Up the ramp: heading and middle are held by two PD rules, the end is told by tilt and path."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np

from rover_common.geometry import Pose, wrap_angle
from rover_common.sensor_types import LaserScan, Twist
from rover_heat.config import HeatConfig
from rover_heat.scan_window import ranges_around
from rover_heat.tilt import Lean

TURN_MAX = 0.6  # [rad/s]
SIDE_WINDOW = math.radians(5.0)  # around straight to either side
SIDE_REACH = 1.0  # [m] of a wall that guides
RISE_LEAST = 0.04  # [m] by which the robot has come up when level ground is the flat part
LEVEL, LEVEL_SECONDS = 0.03, 0.3  # [rad], [s]
DOWNHILL = 0.05  # [rad] of the nose down after the rise: it is beyond the flat part
BACK_SPEED = 0.08  # [m/s]
# [m] of the wheels' path in which the robot must have come up: else they slip, or there is no ramp
SLIP_PATH = 1.0
STALLED_SECONDS = 1.0  # [s] of wheels that are told to turn and do not
WHEELS_STAND = 0.02  # [m/s]
FAST = 0.20  # [m/s] of another try
# Where there is no ramp the robot must not run into what is ahead.
AHEAD_WINDOW, AHEAD_LEAST = math.radians(25.0), 0.25  # [rad], [m]


class Progress(Enum):
    CLIMBING = "climbs"
    BACKING = "is beyond the flat part: backs"
    ON_TOP = "level again: on the flat part"
    FAILED = "does not get up"


@dataclass(frozen=True)
class ClimbInput:
    """What one tick tells."""

    time: float  # [s]
    pose: Pose
    speed: float  # [m/s] by the wheels
    lean: Lean
    scan: LaserScan | None  # the newest


class Climb:
    """One try, from before the foot on."""

    def __init__(self, yaw: float, speed: float, config: HeatConfig) -> None:
        """yaw [rad] of the rise; speed [m/s]."""
        self._yaw = yaw
        self._speed = speed
        self._config = config
        self._last: tuple[float, float, float | None] | None = None  # time, heading, sides
        self._level_since: float | None = None
        self._stands_since: float | None = None
        self._way = 0.0  # [m] of the wheels' path so far
        self._rise = 0.0  # [m]
        self._risen = False
        self.progress = Progress.CLIMBING
        self.twist = Twist()

    def update(self, seen: ClimbInput) -> None:
        """One tick: how it gets on, and the velocity for it."""
        self._advance(seen)
        turn = self._turn(seen)
        speed = {Progress.CLIMBING: self._speed, Progress.BACKING: -BACK_SPEED}
        self.twist = Twist(speed[self.progress], turn) if self.progress in speed else Twist()

    def _advance(self, seen: ClimbInput) -> None:
        if self.progress in (Progress.ON_TOP, Progress.FAILED):
            return
        if self._last is not None:
            step = seen.speed * (seen.time - self._last[0])
            self._way += step
            self._rise += step * math.sin(-seen.lean.pitch)
        level = abs(seen.lean.pitch) < LEVEL
        self._level_since = (self._level_since or seen.time) if level else None
        self._risen |= self._rise >= RISE_LEAST
        if not self._risen:
            if self._way > SLIP_PATH or self._stalls(seen) or self._blocked(seen):
                self.progress = Progress.FAILED
        elif self._ends(seen):
            self.progress = Progress.ON_TOP
        elif seen.lean.pitch > DOWNHILL and self._config.ramp_end == "top":
            self.progress = Progress.BACKING

    def _ends(self, seen: ClimbInput) -> bool:
        if self._config.ramp_end == "wall":
            return (
                float(np.median(ranges_around(seen.scan, 0.0, SIDE_WINDOW)))
                < self._config.stop_front
            )
        since = self._level_since
        return since is not None and seen.time - since >= LEVEL_SECONDS

    @staticmethod
    def _blocked(seen: ClimbInput) -> bool:
        return float(ranges_around(seen.scan, 0.0, AHEAD_WINDOW).min()) < AHEAD_LEAST

    def _stalls(self, seen: ClimbInput) -> bool:
        moving = abs(seen.speed) > WHEELS_STAND
        self._stands_since = None if moving else (self._stands_since or seen.time)
        since = self._stands_since
        return since is not None and seen.time - since > STALLED_SECONDS

    def _turn(self, seen: ClimbInput) -> float:
        """[rad/s] By the error of the heading, and by the walls to either side."""
        config = self._config
        heading = wrap_angle(self._yaw - seen.pose.yaw)
        left, right = (
            float(
                np.median(ranges_around(seen.scan, self._yaw + side - seen.pose.yaw, SIDE_WINDOW))
            )
            for side in (math.pi / 2, -math.pi / 2)
        )
        sides = left - right if max(left, right) < SIDE_REACH else None
        turn = config.kp_yaw * heading + config.kp_wall * (sides or 0.0)
        if self._last is not None and seen.time > self._last[0]:
            time, last_heading, last_sides = self._last
            seconds = seen.time - time
            turn += config.kd_yaw * wrap_angle(heading - last_heading) / seconds
            if sides is not None and last_sides is not None:
                turn += config.kd_wall * (sides - last_sides) / seconds
        self._last = (seen.time, heading, sides)
        return max(-TURN_MAX, min(TURN_MAX, turn))


def _range_at(seen: ClimbInput, bearing: float) -> float:
    """[m]"""
    return float(np.median(ranges_around(seen.scan, bearing, SIDE_WINDOW)))
