"""Detectors of trouble: one list of pure functions, shared by all missions."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass
from enum import Enum

from rover_navigation.types import PlanFailed


@dataclass(frozen=True)
class Health:
    """What the detectors see at one frame."""

    tilt: float  # [rad] of pitch or roll, the larger one; or in the unit of the mission's limit
    gap: float  # [s] without input
    jump: float  # [m] of the pose from the frame before
    stopped_moving: bool  # it does not get on although it is told to
    plan_age: float  # [s] since the newest plan's map, or since the run's first frame
    map_age: float  # [s] since the newest map that was due, or since the run's first frame
    plan_failure: PlanFailed | None  # the planner's newest answer, when it was no plan
    clock_error: float = 0.0  # [s] between the stamps of the inputs and the node's clock
    navigator_silent: float = 0.0  # [s] since the navigator was last there


@dataclass(frozen=True)
class Limits:
    """From where on it is trouble."""

    tilt: float  # [rad] of pitch or roll, or in the mission's own unit
    gap: float  # [s] the robot drove blindly
    jump: float  # [m] somebody has moved it
    plan_age: float  # [s]
    map_age: float  # [s]
    clock_error: float = math.inf  # [s]
    navigator_silent: float = math.inf  # [s]


class Trouble(Enum):
    """Kinds of trouble, the most urgent first; a mission's events bear the same names."""

    tilted = "tilted too far"
    input_gap = "frames were missing, or the pose jumped"
    clock_apart = "the clocks are apart"
    navigator_lost = "the navigator is silent"
    stopped_moving = "no progress although driving"
    planner_failed = "the planner failed"
    plan_stale = "the plan is too old"
    map_stale = "the map is too old"


Detector = Callable[[Health, Limits], bool]

DETECTORS: dict[Trouble, Detector] = {
    Trouble.tilted: lambda h, limits: h.tilt > limits.tilt,
    Trouble.input_gap: lambda h, limits: h.gap > limits.gap or h.jump > limits.jump,
    Trouble.clock_apart: lambda h, limits: h.clock_error > limits.clock_error,
    Trouble.navigator_lost: lambda h, limits: h.navigator_silent > limits.navigator_silent,
    Trouble.stopped_moving: lambda h, limits: h.stopped_moving,
    Trouble.planner_failed: lambda h, limits: h.plan_failure is not None,
    Trouble.plan_stale: lambda h, limits: h.plan_age > limits.plan_age,
    Trouble.map_stale: lambda h, limits: h.map_age > limits.map_age,
}

PLANNING = frozenset({Trouble.planner_failed, Trouble.plan_stale, Trouble.map_stale})
INPUTS = PLANNING | {Trouble.input_gap}
MOTION = frozenset({Trouble.tilted, Trouble.input_gap, Trouble.stopped_moving})


def first_trouble(health: Health, limits: Limits, watched: Collection[Trouble]) -> Trouble | None:
    """The most urgent trouble of those watched, None when all is well."""
    for trouble, detect in DETECTORS.items():
        if trouble in watched and detect(health, limits):
            return trouble
    return None
