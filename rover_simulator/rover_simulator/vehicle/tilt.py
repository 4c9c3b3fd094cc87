"""The tilt of the body on its suspension: it rocks between the stops."""

from __future__ import annotations

import math
from typing import NamedTuple

from rover_common.vehicle import ROVER
from rover_simulator.vehicle.ground import Ground

# The body rocks: period 1.9 s, damping ratio 0.085.
ROCKING = 2 * math.pi / 1.9  # [rad/s]
DAMPING = 0.085
PITCH_PER_ACCELERATION = math.radians(2.5)  # [rad s^2/m]
ROLL_PER_ACCELERATION = math.radians(3.5)  # [rad s^2/m]


class Swing(NamedTuple):
    """The motion of the body about one axis."""

    angle: float = 0.0  # [rad]
    rate: float = 0.0  # [rad/s]

    def step(self, ground: float, lean: float, stop: float, seconds: float) -> Swing:
        """Rock towards ground of an angle [rad] and the lean [rad] that forces give against it.

        The suspension's stop [rad] holds the body, and takes its rate away.
        """
        offset = ground + max(-stop, min(stop, lean)) - self.angle
        rate = self.rate + (ROCKING**2 * offset - 2 * DAMPING * ROCKING * self.rate) * seconds
        angle = self.angle + rate * seconds
        held = max(ground - stop, min(ground + stop, angle))
        return Swing(held, rate if held == angle else 0.0)


class Tilt(NamedTuple):
    """The body's pitch, nose down positive, and its roll, left side up positive."""

    pitch: Swing
    roll: Swing

    def step(self, ground: Ground, forward: float, leftward: float, seconds: float) -> Tilt:
        """One step on this ground, under forces per mass [m/s^2].

        The centre of mass lies below the ground: throttle lowers the nose, turns lean inward.
        """
        dive, lean = PITCH_PER_ACCELERATION * forward, -ROLL_PER_ACCELERATION * leftward
        return Tilt(
            self.pitch.step(ground.pitch, dive, ROVER.pitch_stop, seconds),
            self.roll.step(ground.roll, lean, ROVER.roll_stop, seconds),
        )
