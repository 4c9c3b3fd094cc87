"""The vehicle's shortest time between two stops on free, flat ground."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_simulator.vehicle.ground import FLAT
from rover_simulator.vehicle.vehicle import BRAKE_INPUT, STEP, Controls, Vehicle

THROTTLE = Controls(throttle=1.0)  # the most that the bridge sends
BRAKE = Controls(brake=BRAKE_INPUT[-1])  # harder ones do not stop it sooner
SPEEDS = np.linspace(0.0, ROVER.max_speed, 501)  # [m/s] at which the profile is kept


@dataclass(frozen=True)
class Profile:
    """Acceleration and braking, by the speed reached (SPEEDS)."""

    seconds: NDArray[np.float64]  # to reach the speed from standstill and to stop again
    metres: NDArray[np.float64]


@cache
def profile() -> Profile:
    """Of the simulator's vehicle on flat ground."""
    start = Pose(0.0, 0.0, 0.0)
    accelerating = _drive(Vehicle(start), THROTTLE)
    rolling = Vehicle(start)
    rolling.roll_on(ROVER.max_speed, THROTTLE)
    braking = _drive(rolling, BRAKE)
    # The rest of the braking once the speed is reached, so that both grow with speed.
    braking = (braking[-1] * (1, 1, 0) - braking * (1, 1, -1))[::-1]
    parts = [
        np.interp(SPEEDS, table[:, 2], table[:, column])
        for table in (accelerating, braking)
        for column in (0, 1)
    ]
    return Profile(parts[0] + parts[2], parts[1] + parts[3])


def leg_seconds(metres: float) -> float:
    """Time [s] for a straight leg, from standstill to standstill."""
    both = profile()
    top = float(np.interp(metres, both.metres, SPEEDS))
    cruise = max(0.0, metres - float(both.metres[-1])) / ROVER.max_speed
    return float(np.interp(top, SPEEDS, both.seconds)) + cruise


def _drive(vehicle: Vehicle, controls: Controls) -> NDArray[np.float64]:
    """Rows of time [s], distance [m] and speed [m/s] until the speed does not change any more."""
    rows = [(0.0, 0.0, vehicle.speed)]
    while True:
        vehicle.step(controls, FLAT)
        rows.append((rows[-1][0] + STEP, vehicle.pose.x, vehicle.speed))
        if rows[-1][2] == rows[-2][2]:
            return np.array(rows[:-1])
