"""Commands of the classic solutions. Their steering is the wanted bearing itself, clipped."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.types import Command
from rover_common.vehicle import ROVER

BRAKE = 10.0  # the wheels lock
HARD = ROVER.max_steering  # [rad]


@dataclass(frozen=True)
class Pace:
    """How hard it drives, and up to which speed; beyond, it coasts."""

    throttle: float
    top_speed: float  # [m/s]


def clipped(bearing: float) -> float:
    """The steering angle [rad] for a wanted bearing [rad]."""
    return max(-HARD, min(HARD, bearing))


def drive(speed: float, bearing: float, pace: Pace) -> Command:
    """Drive on, steered to a bearing [rad]."""
    throttle = pace.throttle if speed < pace.top_speed else 0.0
    return Command(throttle=throttle, steering_angle=clipped(bearing))


def coast(steering: float) -> Command:
    """Neither throttle nor brake: a standing rover turns in place."""
    return Command(steering_angle=clipped(steering))


def reverse(throttle: float, steering: float = 0.0) -> Command:
    """Back up; throttle is positive."""
    return Command(throttle=-throttle, steering_angle=clipped(steering))


def stop() -> Command:
    """All wheels locked."""
    return Command(brake=BRAKE)
