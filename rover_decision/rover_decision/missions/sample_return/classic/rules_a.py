"""The rules of classic A: what the ground in view says, and what is commanded then."""

from __future__ import annotations

import numpy as np

from rover_common.types import Command, PolarArray
from rover_decision.missions.sample_return.classic.commands import (
    HARD,
    Pace,
    drive,
    reverse,
)
from rover_decision.missions.sample_return.classic.ground import Ground

PACE = Pace(throttle=0.3, top_speed=3.0)
ROCK_PACE = Pace(throttle=0.2, top_speed=1.0)
STOP_FORWARD = 170  # cells, fewer are too few to drive on
GO_FORWARD = 500  # cells, enough to go on after a stop
LEAST_MEAN_RANGE = 1.0  # [m] of the ground in view
PERCENTILE, OF_PERCENTILE, OF_MEAN = 85, 0.5, 0.4
STOP_SPEED = 0.2  # [m/s] up to which it stands
BACK_OFF = 2.0  # throttle
BACK_OUT = 3.0  # throttle, when nothing moves


def wall_bearing(ground: Ground) -> float:
    """Along the left wall [rad]: half the 85th percentile and 0.4 of the mean of the bearings."""
    if len(ground.bearings) == 0:
        return 0.0
    percentile = np.percentile(ground.bearings, PERCENTILE)
    return float(OF_PERCENTILE * percentile + OF_MEAN * ground.mean_bearing())


def is_blocked(ground: Ground) -> bool:
    """Too little ground in view, or all of it too near."""
    return ground.cells < STOP_FORWARD or float(ground.ranges.mean()) < LEAST_MEAN_RANGE


def is_clear(ground: Ground) -> bool:
    """Enough ground to go on after a stop."""
    return ground.cells >= GO_FORWARD


def follow_wall(ground: Ground, speed: float, held: float) -> Command:
    """Drive along the left wall; while it still rolls back, the steering [rad] is held."""
    return drive(speed, held if speed < 0 else wall_bearing(ground), PACE)


def three_point_turn(ground: Ground) -> Command:
    """Back up with the wheels turned to the leftmost ground, hard left where none is in view."""
    leftmost = float(ground.bearings.max()) if len(ground.bearings) else HARD
    return reverse(BACK_OFF, leftmost)


def to_rock(rock: PolarArray, speed: float) -> Command:
    """Slowly, to the mean bearing of the rock's cells."""
    return drive(speed, float(rock.bearings.mean()), ROCK_PACE)


def back_out() -> Command:
    """Stuck: hard back with the wheels turned left."""
    return reverse(BACK_OUT, HARD)


def push() -> Command:
    """Full throttle straight ahead."""
    return Command(throttle=1.0)


def homeward(ground: Ground, speed: float, bearing: float) -> Command:
    """To a bearing [rad]; without ground ahead back, with the opposite steering.

    A rover that rolls back from a slope steers the opposite way as well: else it would come back to
    the slope on the arc that it rolled back on.
    """
    if ground.cells < STOP_FORWARD:
        return reverse(BACK_OFF, -bearing)
    return drive(speed, bearing if speed >= 0 else -bearing, PACE)
