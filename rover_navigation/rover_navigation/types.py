"""What the planner takes and gives."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.types import GridMap, RockTrack
from rover_navigation.costmap import Blocked


class GoalKind(Enum):
    FRONTIER = "the edge of the unknown"
    ROCK = "a rock"
    SEARCH = "ground not searched for rocks"


@dataclass(frozen=True)
class Goal:
    """Where to go next."""

    kind: GoalKind
    x: float  # [m] map frame
    y: float  # [m]
    rock_id: int | None = None


@dataclass(frozen=True)
class Way:
    """Points to drive along, from the rover on."""

    points: NDArray[np.float64]  # (n, 2) [m] map frame
    speeds: NDArray[np.float64]  # (n,) [m/s] limit by the room around each point

    def __len__(self) -> int:
        return len(self.points)


NO_WAY = Way(np.empty((0, 2)), np.empty(0))


@dataclass(frozen=True)
class Searched:
    """From how near each piece of ground was looked at: whether a rock would have shown."""

    geometry: GridGeometry
    distance: NDArray[np.float32]  # (rows, cols) [m] the nearest look, inf where there was none


@dataclass(frozen=True)
class PlanRequest:
    """What the mission knows at the frame at which it asks."""

    stamp: int  # [ns] of that frame, and of the map
    grid: GridMap
    pose: Pose
    home: tuple[float, float]  # [m]
    trail: NDArray[np.float64]  # (n, 2) [m] where the rover has been
    rocks: tuple[RockTrack, ...]  # worth going for now
    blocked: tuple[Blocked, ...]
    visited: NDArray[np.float64]  # (n, 3) [m] x, y, radius of what was looked at in vain
    doubtful: NDArray[np.float64]  # (n, 3) [m] the same, so long ago that it may be tried again
    searched: Searched | None
    search: bool  # whether samples are left: rocks that nobody has seen, when none is in reach
    last_goal: Goal | None
    home_by_crumbs: bool = False  # the way home is to be made of the trail, not of the map


@dataclass(frozen=True)
class Plan:
    """Where to go, and the way there."""

    stamp: int  # [ns] of the request
    goal: Goal | None  # None when nothing is left to do out there
    way: Way  # to the goal
    home_way: Way  # back to the start, empty where the map shows none
    home_seconds: float  # [s] estimate for that
    frontiers: NDArray[np.float64]  # (n, 2) [m] centres, for people
    explored: float  # 0..1 estimate
    placed: bool = True  # whether the rover stands on known ground: else the plan says nothing
