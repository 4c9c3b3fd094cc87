"""Up a known ramp: to its foot, in line with it, up, and down again to try once more."""

from __future__ import annotations

import math
from enum import Enum

from rover_common.geometry import distance_between, wrap_angle
from rover_common.sensor_types import Twist
from rover_heat.mission.back_track import towards
from rover_heat.mission.ownership import STAND
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.tick import HeatTick
from rover_heat.mission.trip import TripStatus
from rover_heat.ramp.climb import FAST, Climb, ClimbInput, Progress
from rover_heat.ramp.estimate import Ramp

TRIES = 3
TOLERANCE = 0.05  # [m] of the place before the foot
ALIGNED, TURN_SECONDS = math.radians(2.0), 6.0  # [rad], [s]
TURN_GAIN, TURN_LEAST, TURN_MAX = 1.5, 0.12, 0.6  # [1/s], [rad/s], [rad/s]
CLIMB_SECONDS, RETREAT_SECONDS = 20.0, 20.0  # [s]
BEFORE_FOOT = 0.50  # [m] of where a retreat ends
REACHED = 0.08  # [m]


class Phase(Enum):
    CHOOSING = "waits for a plan to the ramp"
    APPROACHING = "drives to the foot of the ramp"
    TURNING = "turns to the ramp"
    CLIMBING = "climbs"
    RETREATING = "backs down for another try"
    ON_TOP = "stands on the ramp"
    GIVEN_UP = "does not get up the ramp"


class RampAttempt:
    def __init__(self, parts: HeatParts) -> None:
        self._parts = parts
        self._ramp: Ramp | None = None
        self._climb: Climb | None = None
        self._since = 0.0  # [s] of the phase
        self._tries = 0
        self.phase = Phase.CHOOSING
        self.twist: Twist | None = STAND

    def restart(self, time: float) -> None:
        """After an interruption: what is not yet on the ramp begins anew."""
        if self.phase in (Phase.CHOOSING, Phase.APPROACHING):
            self._enter(Phase.CHOOSING, time)

    def update(self, tick: HeatTick) -> None:
        """One tick."""
        step = {
            Phase.CHOOSING: self._choose,
            Phase.APPROACHING: self._approach,
            Phase.TURNING: self._turn,
            Phase.CLIMBING: self._go_up,
            Phase.RETREATING: self._retreat,
        }.get(self.phase)
        self.twist = STAND
        if step is not None:
            step(tick)

    @property
    def on_wheels_alone(self) -> bool:
        """Whether a tilt is what is wanted."""
        return self.phase not in (Phase.CHOOSING, Phase.APPROACHING)

    def _enter(self, phase: Phase, time: float) -> None:
        self.phase, self._since = phase, time

    def _choose(self, tick: HeatTick) -> None:
        best = self._parts.ramps.best()
        if best is not None:
            self._ramp, stand = best
            self._parts.trip.start(stand.pose, TOLERANCE, stand.seconds)
            self._enter(Phase.APPROACHING, tick.time)
            self.twist = None
        elif tick.time - self._since > CLIMB_SECONDS:
            self._enter(Phase.GIVEN_UP, tick.time)

    def _approach(self, tick: HeatTick) -> None:
        self.twist = None
        if self._parts.trip.status is TripStatus.REACHED:
            self._enter(Phase.TURNING, tick.time)
        elif self._parts.trip.status is TripStatus.FAILED:
            self._parts.notices.append(f"ramp: {self._parts.trip.reason}")
            self._fail(tick.time)

    def _turn(self, tick: HeatTick) -> None:
        assert self._ramp is not None
        error = wrap_angle(self._ramp.yaw - tick.pose.yaw)
        if abs(error) < ALIGNED or tick.time - self._since > TURN_SECONDS:
            speed = self._parts.config.ramp_speed if self._tries == 0 else FAST
            self._climb = Climb(self._ramp.yaw, speed, self._parts.config)
            self._enter(Phase.CLIMBING, tick.time)
            return
        rate = min(TURN_MAX, max(TURN_LEAST, TURN_GAIN * abs(error)))
        self.twist = Twist(0.0, math.copysign(rate, error))

    def _go_up(self, tick: HeatTick) -> None:
        climb, parts = self._climb, self._parts
        assert climb is not None
        speed = tick.frame.twist.linear
        climb.update(ClimbInput(tick.time, tick.pose, speed, parts.tilt.lean, parts.scan))
        self.twist = climb.twist
        if climb.progress is Progress.ON_TOP:
            self._enter(Phase.ON_TOP, tick.time)
        elif climb.progress is Progress.FAILED or tick.time - self._since > CLIMB_SECONDS:
            parts.notices.append("ramp: does not get up")
            self._enter(Phase.RETREATING, tick.time)

    def _retreat(self, tick: HeatTick) -> None:
        assert self._ramp is not None
        target = self._ramp.before_foot(BEFORE_FOOT)
        back = distance_between(target, tick.pose) < REACHED
        if back or tick.time - self._since > RETREAT_SECONDS:
            self._fail(tick.time)
        else:
            self.twist = towards(target, tick.pose)

    def _fail(self, time: float) -> None:
        self._tries += 1
        self._enter(Phase.GIVEN_UP if self._tries >= TRIES else Phase.CHOOSING, time)
