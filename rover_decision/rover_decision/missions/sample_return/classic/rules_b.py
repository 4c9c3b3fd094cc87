"""The rules of classic B: what the ground in view says, and what is commanded then."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.types import Command, PolarArray
from rover_decision.missions.sample_return.classic.commands import (
    HARD,
    Pace,
    coast,
    drive,
    reverse,
    stop,
)
from rover_decision.missions.sample_return.classic.ground import Ground

STOP_FORWARD = 50  # cells, fewer are too few to drive on
GO_FORWARD = 500  # cells, enough to go on after a stop
NAV_RANGE = 5.0  # [m] of the ground and the rocks that bearings and cells are counted of
STRIP = 2.0  # [m] to either side
STOP_SIDE = 50  # cells of a side of the strip, fewer are too few to pass
LEFT_RIGHT_RATIO = 2.0  # so many times more cells are much more room
STOP_SPEED = 0.2  # [m/s] up to which it stands
HOME_PERCENTILES = (25, 75)
ROCK_CELLS = 1  # at least, to go for a rock


@dataclass(frozen=True)
class Manner:
    """How a state drives: its pace, and its bias to the left."""

    pace: Pace
    bias: float  # [rad]


EXPLORING = Manner(Pace(throttle=0.2, top_speed=1.5), math.radians(10.0))
OUT_OF_CIRCLE = Manner(EXPLORING.pace, 0.0)
HOMEWARD = Manner(EXPLORING.pace, 0.0)
ROCK_PACE = Pace(throttle=0.2, top_speed=0.5)
DRIVE_OUT = Manner(Pace(throttle=1.0, top_speed=2.0), 0.0)
BACK_OUT = 1.0  # throttle
BACK_UNTIL, BRAKE_UNTIL, TURN_UNTIL, MANOEUVRE = 6.0, 7.0, 8.0, 13.0  # [s]
CLEAR_DISTANCE = 2.0  # [m] from where it got stuck
OUT_OF_CIRCLE_SECONDS = 10.0  # [s]


@dataclass(frozen=True)
class View:
    """One frame's ground: all of it, the near part, and how much each near bearing counts."""

    ground: Ground
    near: Ground
    weights: NDArray[np.float64] | None = None  # (n,) of the near bearings, equal if None

    @classmethod
    def of(cls, ground: Ground) -> View:
        return cls(ground, ground.within(NAV_RANGE))

    def mean_bearing(self) -> float:
        """[rad]"""
        return self.near.mean_bearing(self.weights)


def is_blocked(view: View) -> bool:
    """Too little ground in view."""
    return view.near.cells < STOP_FORWARD


def is_clear(view: View) -> bool:
    """Enough ground to go on after a stop."""
    return view.near.cells >= GO_FORWARD


def away_from_side(view: View) -> Command | None:
    """A hard turn away from a side without room, None where both have some."""
    left, right = view.ground.sides(STRIP)
    if left < STOP_SIDE:
        return coast(-HARD)
    return coast(HARD) if right < STOP_SIDE else None


def to_wide_side(view: View) -> float | None:
    """The mean bearing [rad] of a side that has much more room, None where neither has."""
    left, right = view.ground.sides(STRIP)
    bearings = view.near.bearings
    if right >= LEFT_RIGHT_RATIO * left:
        side = bearings[bearings < 0]
    elif left >= LEFT_RIGHT_RATIO * right:
        side = bearings[bearings >= 0]
    else:
        return None
    return float(side.mean()) if len(side) else None


def bearing_home(view: View, home: float) -> float:
    """Of the middle half of the near bearings, the one [rad] closest to home's."""
    if len(view.near.bearings) == 0:
        return 0.0
    low, high = np.percentile(view.near.bearings, HOME_PERCENTILES)
    return float(np.clip(home, low, high))


def careful_drive(view: View, speed: float, manner: Manner, home: float | None = None) -> Command:
    """Sides first, then home [rad] if that is where it goes, else the mean bearing and the bias."""
    hard_turn = away_from_side(view)
    if hard_turn is not None:
        return hard_turn
    bearing = to_wide_side(view)
    if bearing is None and home is not None:
        bearing = bearing_home(view, home)
    if bearing is None:
        bearing = view.mean_bearing() + manner.bias
    return drive(speed, bearing, manner.pace)


def turn_right() -> Command:
    """In place, in search of ground: the wall to follow is on the left."""
    return coast(-HARD)


def set_out(view: View, speed: float, manner: Manner) -> Command:
    """Go on after a stop."""
    return drive(speed, view.mean_bearing() + manner.bias, manner.pace)


def nearest_rock(rock: PolarArray) -> float | None:
    """Bearing [rad] of the nearest rock cell, so that two rocks do not confuse it."""
    if np.count_nonzero(rock.ranges < NAV_RANGE) < ROCK_CELLS:
        return None
    return float(rock.bearings[np.argmin(rock.ranges)])


def wide_side(ground: Ground) -> float:
    """Steering [rad] to the side with more ground: left if there is much more, else right."""
    left = np.count_nonzero(ground.bearings >= 0)
    right = len(ground.bearings) - left
    return HARD if left > LEFT_RIGHT_RATIO * right else -HARD


def to_rock(bearing: float, speed: float) -> Command:
    """Roll on, steered to the rock [rad]; slowly on if that has nearly come to an end.

    A rover that stands turns to it in place first.
    """
    return coast(bearing) if abs(bearing) >= HARD else drive(speed, bearing, ROCK_PACE)


def unstuck(view: View, speed: float, since: float) -> Command:
    """The manoeuvre, `since` [s] after it began; it repeats: back, brake, turn, drive out."""
    phase = since % MANOEUVRE
    if phase < BACK_UNTIL:
        return reverse(BACK_OUT)
    if phase < BRAKE_UNTIL:
        return stop()
    if phase < TURN_UNTIL:
        return coast(wide_side(view.ground))
    return careful_drive(view, speed, DRIVE_OUT)
