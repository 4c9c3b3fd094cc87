"""What the planner takes and gives."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.types import GridMap


class GoalKind(Enum):
    FRONTIER = "a frontier"
    TARGET = "a target"
    SEARCH = "ground not searched for targets"


@dataclass(frozen=True)
class Goal:
    """Where to go next."""

    kind: GoalKind
    x: float  # [m] map frame
    y: float  # [m]
    target_id: int | None = None


@dataclass(frozen=True)
class Target:
    """A place that the mission wants to get to, whatever is there."""

    id: int
    x: float  # [m] map frame
    y: float  # [m]
    reach: float  # [m] from the end of the path
    worth: float = math.inf  # [s] of detour at most


@dataclass(frozen=True)
class Path:
    """Points to drive along, from the robot on."""

    points: NDArray[np.float64]  # (n, 2) [m] map frame
    speeds: NDArray[np.float64]  # (n,) [m/s] limit by the clearance around each point

    def __len__(self) -> int:
        return len(self.points)


NO_PATH = Path(np.empty((0, 2)), np.empty(0))
NO_POINTS: NDArray[np.float64] = np.empty((0, 2))


@dataclass(frozen=True)
class BlockedPlace:
    """A place that proved impassable."""

    x: float  # [m] map frame
    y: float  # [m]
    radius: float  # [m]
    until: float = math.inf  # [s] frame time


@dataclass(frozen=True)
class Coverage:
    """From how near each cell was observed: whether a target would have shown."""

    geometry: GridGeometry
    distance: NDArray[np.float32]  # (rows, cols) [m] the nearest observation, inf where none


@dataclass(frozen=True)
class PlanRequest:
    """What the mission knows at the frame at which it asks, and the map of that frame."""

    grid: GridMap
    stamp: int  # [ns] of that frame
    pose: Pose
    home: tuple[float, float]  # [m]
    trail: NDArray[np.float64] = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] driven
    targets: tuple[Target, ...] = ()  # worth going to now
    blocked: tuple[BlockedPlace, ...] = ()
    # (n, 3) [m] x, y, radius: goals not to go to now, and those observed without result before
    blacklisted: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 3)))
    retryable: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 3)))
    coverage: Coverage | None = None
    search: bool = False  # whether there are targets that nobody has seen yet
    last_goal: Goal | None = None
    home_by_breadcrumbs: bool = False  # the home path is to be made of the trail, not of the map


@dataclass(frozen=True)
class Plan:
    """Where to go, and the path there."""

    stamp: int  # [ns] of the request
    goal: Goal | None  # None when nothing is left to do out there
    path: Path  # to the goal
    home_path: Path  # back to the start, empty where the map shows none
    home_seconds: float  # [s] estimate for that
    frontiers: NDArray[np.float64]  # (n, 2) [m] centres, for people
    explored: float  # 0..1 estimate
    placed: bool = True  # whether the robot stands on known ground: else the plan says nothing


@dataclass(frozen=True)
class PlanFailed:
    """A plan that was asked for and did not come."""

    stamp: int  # [ns] of the request
    reason: str
