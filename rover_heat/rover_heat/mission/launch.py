"""One launch: turn to the warm place, stand still, signal once, wait for the report."""

from __future__ import annotations

import math
from enum import Enum

from rover_common.geometry import bearing_to, wrap_angle
from rover_common.sensor_types import Twist
from rover_heat.mission.ownership import STAND
from rover_heat.mission.parts import SEQUENCE_SECONDS, HeatParts
from rover_heat.mission.tick import HeatTick
from rover_heat.tilt import FIT_TILT
from rover_heat.types import HeatSource

ALIGN_SECONDS = 5.0  # [s] of turning to the warm column; then to where the source is known to be
MISSED_SECONDS = 12.0  # [s] without a signal: what keeps the robot from standing still stays
ALIGNED = math.radians(2.5)  # [rad]
STILL_SECONDS = 0.4  # [s]
STILL_SPEED, STILL_TURN = 0.01, 0.03  # [m/s], [rad/s]
TURN_GAIN, TURN_LEAST, TURN_MAX = 1.5, 0.12, 0.6  # [1/s], [rad/s], [rad/s]
AHEAD = math.radians(30.0)  # a sensor that looks this far aside at most sees what is ahead
TRUSTED = math.radians(25.0)  # between the warm column and where the source is known to be


class Phase(Enum):
    ALIGNING = "turns to the source"
    STILLING = "stands still"
    WAITING = "the launcher works"
    DONE = "launched"
    MISSED = "does not come to rest"


class Launch:
    """Without a source it does not turn: it signals as soon as the robot stands."""

    def __init__(self, parts: HeatParts) -> None:
        self._parts = parts
        self._phase = Phase.ALIGNING
        self._begun = 0.0  # [s]
        self._still_since: float | None = None  # [s]
        self._signalled_at: float | None = None  # [s]
        self.signalled_now = False  # at this tick
        self.twist = STAND

    def begin(self, time: float, source: HeatSource | None) -> None:
        """The robot stands where it launches; one that has been signalled goes on."""
        self.signalled_now = False
        if not self.signalled:
            self._begun = time
            self._phase = Phase.ALIGNING if source is not None else Phase.STILLING

    @property
    def signalled(self) -> bool:
        return self._signalled_at is not None

    @property
    def done(self) -> bool:
        return self._phase is Phase.DONE

    @property
    def missed(self) -> bool:
        return self._phase is Phase.MISSED

    @property
    def reason(self) -> str:
        return self._phase.value

    def update(self, tick: HeatTick, source: HeatSource | None) -> None:
        """One tick."""
        self.signalled_now = False
        self.twist = STAND
        if self._signalled_at is not None:
            self._wait(tick, self._signalled_at)
        elif tick.time - self._begun > MISSED_SECONDS:
            self._phase = Phase.MISSED
        elif source is not None and self._turns(tick, source):
            self._phase, self._still_since = Phase.ALIGNING, None
        else:
            self._phase = Phase.STILLING
            self._signal_when_still(tick)

    def _turns(self, tick: HeatTick, source: HeatSource) -> bool:
        """Whether it has to turn, and how fast."""
        error = self._error(tick, source)
        if abs(error) < ALIGNED or (self._still_since is not None and abs(error) < 2 * ALIGNED):
            return False
        rate = min(TURN_MAX, max(TURN_LEAST, TURN_GAIN * abs(error)))
        self.twist = Twist(0.0, math.copysign(rate, error))
        return True

    def _error(self, tick: HeatTick, source: HeatSource) -> float:
        """[rad] To the warm column, to the source's place where none is seen; left positive."""
        known = bearing_to(tick.pose, source.x, source.y)
        if tick.time - self._begun > ALIGN_SECONDS:
            return known
        seen = [
            bearing
            for bearing in map(self._parts.sensing.bearing, self._parts.sensing.alive)
            if bearing is not None and abs(bearing) <= AHEAD
            and abs(wrap_angle(bearing - known)) <= TRUSTED
        ]  # fmt: skip
        return min(seen, key=abs, default=known)

    def _signal_when_still(self, tick: HeatTick) -> None:
        parts, twist = self._parts, tick.frame.twist
        still = (
            abs(twist.linear) < STILL_SPEED
            and parts.tilt.turn_now < STILL_TURN
            and parts.tilt.lean.slope < FIT_TILT
        )
        if not still:
            self._still_since = None
        elif self._still_since is None:
            self._still_since = tick.time
        elif tick.time - self._still_since >= STILL_SECONDS:
            self._signalled_at, self.signalled_now = tick.time, True
            self._phase = Phase.WAITING

    def _wait(self, tick: HeatTick, signalled_at: float) -> None:
        if self._phase is Phase.DONE:
            return
        if tick.frame.launches_done > 0:
            self._phase = Phase.DONE
        elif tick.time - signalled_at > SEQUENCE_SECONDS:
            self._phase = Phase.DONE
            self._parts.notices.append("warning: the launcher did not report; counted as launched")
