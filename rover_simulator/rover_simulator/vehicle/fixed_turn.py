"""The fixed turn: the body, held still, is turned by an angle in a time."""

from __future__ import annotations

import math

# The rate of a turn whose event gives no time.
DEFAULT_RATE = math.radians(45.0)  # [rad/s]


class FixedTurn:
    """The turn in progress, if there is one."""

    def __init__(self) -> None:
        self._angle = 0.0  # [rad] still to go, counter-clockwise positive
        self._time = 0.0  # [s] still to go

    @property
    def running(self) -> bool:
        return self._time > 0.0

    def start(self, angle: float, seconds: float) -> None:
        """Turn by `angle` [rad] in `seconds` [s]; a time of 0 means the default rate."""
        self._angle = angle
        self._time = seconds if seconds > 0.0 else abs(angle) / DEFAULT_RATE

    def advance(self, seconds: float) -> float:
        """The angle [rad] by which the body turns in this time [s]."""
        if self._time <= seconds + 1e-9:  # so that whole steps add up
            turned, self._angle, self._time = self._angle, 0.0, 0.0
            return turned
        turned = self._angle * seconds / self._time
        self._angle -= turned
        self._time -= seconds
        return turned
