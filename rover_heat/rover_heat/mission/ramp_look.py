"""On top of the ramp: where the sensor that looks ahead is dead, another one is turned there."""

from __future__ import annotations

import math

from rover_common.geometry import wrap_angle
from rover_common.sensor_types import Twist
from rover_heat.config import thermal_yaw
from rover_heat.mission.launch import AHEAD
from rover_heat.mission.ownership import STAND
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.tick import HeatTick

ALIGNED, TURN_SECONDS = math.radians(3.0), 8.0  # [rad], [s]
TURN_GAIN, TURN_LEAST, TURN_MAX = 1.5, 0.12, 0.4  # [1/s], [rad/s], [rad/s]
LOOK_SECONDS = 3.0  # [s] of frames, and of plans, which make a source of fixes


class RampLook:
    """What stands beyond the ramp is too far away to be examined from the ground before it."""

    def __init__(self, parts: HeatParts) -> None:
        self._parts = parts
        self._heading: float | None = None  # [rad] to turn to
        self._begun = 0.0  # [s] of the turn, then of the look
        self._looks = False
        self.done = False
        self.twist = STAND

    @property
    def reason(self) -> str:
        """What it does."""
        return "looks ahead" if self._looks else "turns a sensor ahead"

    def update(self, tick: HeatTick) -> None:
        """One tick, from the first one on top on."""
        self.twist = STAND
        if self._heading is None:
            self._begin(tick)
        elif self._looks:
            self.done = tick.time - self._begun >= LOOK_SECONDS
        else:
            self._turn(tick, self._heading)

    def _begin(self, tick: HeatTick) -> None:
        parts = self._parts
        aside = min((thermal_yaw(parts.config, n) for n in parts.sensing.alive), key=abs, default=0)
        self.done = abs(aside) <= AHEAD  # it sees what is ahead, or there is none
        self._heading, self._begun = wrap_angle(tick.pose.yaw - aside), tick.time

    def _turn(self, tick: HeatTick, heading: float) -> None:
        error = wrap_angle(heading - tick.pose.yaw)
        if abs(error) < ALIGNED or tick.time - self._begun > TURN_SECONDS:
            self._looks, self._begun = True, tick.time
            return
        rate = min(TURN_MAX, max(TURN_LEAST, TURN_GAIN * abs(error)))
        self.twist = Twist(0.0, math.copysign(rate, error))
