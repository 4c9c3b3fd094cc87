"""The brake of a rover that nobody commands: the original has none."""

from __future__ import annotations

import math

from rover_simulator.vehicle.vehicle import Controls

STOP = Controls(brake=1.0)


class DeadMan:
    """Counts its stops; each lasts until the next command."""

    def __init__(self, seconds: float = math.inf) -> None:
        """seconds: of simulated time without a command until it brakes; infinite for never."""
        self.seconds = seconds
        self.stops = 0
        self.longest = 0.0  # [s] that a rover in motion had neither a new command nor a brake
        self._heard: float | None = None  # [s] when the last command came
        self._braking = False

    def hear(self, time: float) -> None:
        """A command came at this simulated time [s]."""
        self._heard = time
        self._braking = False

    def controls(self, time: float, frame: float, held: Controls, moving: bool) -> Controls:
        """What to hold instead of the last command at this time [s], as a frame [s] begins.

        It brakes with the last frame that begins in time, and never in the first one. By the wall
        clock a command comes up to a frame before the one that it counts from: so long it has
        waited already.
        """
        if self._braking:
            return STOP
        silence = 0.0 if self._heard is None else time - self._heard
        due = silence > 0.0 and silence + 2 * frame > self.seconds
        if not due or not (moving or _drives(held)):
            if moving and held.brake == 0.0:
                self.longest = max(self.longest, silence + frame)
            return held
        self._braking = True
        self.stops += 1
        return STOP


def _drives(controls: Controls) -> bool:
    """Whether a rover that stands would move; without motor and brake it turns in place."""
    return controls.brake == 0.0 and (controls.throttle != 0.0 or controls.steering != 0.0)
