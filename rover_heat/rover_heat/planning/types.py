"""What a plan of the heat mission is made of, and what it says."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.types import GridMap
from rover_heat.ramp.estimate import Ramp
from rover_heat.ramp.hazards import NO_HAZARDS, Hazards
from rover_heat.thermal.coverage import NOTHING, Examined
from rover_heat.thermal.fix import Fix
from rover_heat.thermal.sources import Group
from rover_navigation.types import NO_POINTS

Points = NDArray[np.float64]
NO_DISCS: Points = np.empty((0, 3))


class GoalKind(Enum):
    FRONTIER = "a frontier"
    VIEW = "walls not examined for heat"
    GROUND = "ground where the ramp may be"


# [faces] that a frontier is worth, beside a view that examines so many: a wall of a cell's length
FRONTIER_WORTH = 12.0
LOOK_SECONDS = 1.5  # [s] to brake, to turn and to look


@dataclass(frozen=True)
class HeatGoal:
    """A pose to drive to, and what for."""

    kind: GoalKind
    pose: Pose
    x: float  # [m] what is to be seen from there
    y: float  # [m]
    seconds: float  # [s] to get there
    faces: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] that a view examines

    @property
    def worth(self) -> float:
        """[1/s] What it shows per second."""
        return worth_of(len(self.faces), self.seconds)


def worth_of(faces: int, seconds: float) -> float:
    """[1/s] Of a goal that examines so many faces, 0 for a frontier, and takes so long [s]."""
    return (faces or FRONTIER_WORTH) / (seconds + LOOK_SECONDS)


@dataclass(frozen=True)
class StandOff:
    """Where to stand before a source."""

    pose: Pose
    seconds: float  # [s] to get there


@dataclass(frozen=True)
class HeatPlanRequest:
    """What the mission knows at the tick at which it asks, and the map of that time."""

    stamp: int  # [ns]
    grid: GridMap
    pose: Pose
    fixes: tuple[Fix, ...] = ()
    examined: Examined = NOTHING
    hazards: Hazards = NO_HAZARDS
    ramps: tuple[Ramp, ...] = ()
    trail: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] driven
    known: Points = field(default_factory=lambda: NO_DISCS)  # (n, 3) x, y, radius: observed already
    failed: Points = field(default_factory=lambda: NO_DISCS)  # (n, 3) goals not to choose now
    sensors: tuple[int, ...] = (1, 2)  # thermal ones that are alive
    start: Pose | None = None  # where the mission began
    goal: Pose | None = None  # that is driven to
    seek_ramp: bool = False  # whether goals are to find the ramp


@dataclass(frozen=True)
class HeatPlan:
    """The answer; all in the map frame."""

    stamp: int  # [ns] of the request
    placed: bool = True  # whether the robot stands on known ground: else the plan says nothing
    goals: tuple[HeatGoal, ...] = ()  # the best first
    waiting: tuple[HeatGoal, ...] = ()  # those that have failed of late
    goal_seconds: float = float("inf")  # [s] to the goal that is driven to
    sources: tuple[Group, ...] = ()
    suspects: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] too few fixes
    stand_offs: tuple[tuple[StandOff, ...], ...] = ()  # of each source, the best first
    approaches: tuple[StandOff, ...] = ()  # of each ramp; inf seconds where out of reach
    start_seconds: float = float("inf")  # [s] back to the start
    frontiers: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] middles
    faces: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] examined
    open_faces: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] not yet
    explored: float = float("nan")  # 0..1 of the reachable faces; nan where none is, as on a ramp
