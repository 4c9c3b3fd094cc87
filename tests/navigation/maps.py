"""Maps of free rectangles, plans by hand, and requests for plans."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rover_common.geometry import Pose
from rover_common.types import GridMap
from rover_decision.missions.sample_return.rover_scale import ROVER_SCALE
from rover_navigation.costmap import Costmap
from rover_navigation.planner import Planner
from rover_navigation.selection import NearestStop, WholeTour
from rover_navigation.types import NO_PATH, NO_POINTS, Goal, GoalKind, Path, Plan, PlanRequest

SCALE = ROVER_SCALE
HERE = Pose(20.0, 20.0, 0.0)
MIDDLE = Pose(100.0, 100.0, 0.0)
NO_DISCS = np.empty((0, 3))


def grid(*free: tuple[float, float, float, float]) -> GridMap:
    """A map of 60 x 60 m: free rectangles (x0, y0, x1, y1) [m], walls of 1 m around them."""
    cells = np.full((240, 240), -1, np.int8)
    for x0, y0, x1, y1 in free:
        cells[_cells(y0 - 1.0, y1 + 1.0), _cells(x0 - 1.0, x1 + 1.0)] = 100
    for x0, y0, x1, y1 in free:
        cells[_cells(y0, y1), _cells(x0, x1)] = 0
    return GridMap(0.25, 0.0, 0.0, cells)


def _cells(low: float, high: float) -> slice:
    return slice(round(low * 4), round(high * 4))


def opened(map_: GridMap, x0: float, y0: float, x1: float, y1: float, value: int = -1) -> GridMap:
    """The same map with a part of it unknown, or of another value."""
    cells = map_.cells.copy()
    cells[_cells(y0, y1), _cells(x0, x1)] = value
    return GridMap(map_.resolution, 0.0, 0.0, cells)


HALL = grid((10, 15, 40, 25))
OPEN_EAST = opened(HALL, 40, 16, 41, 24)  # a door in the east wall
UNKNOWN = GridMap(0.25, 0.0, 0.0, np.full((240, 240), -1, np.int8))


def costmap(map_: GridMap, trail: np.ndarray = NO_POINTS, **changes: Any) -> Costmap:
    """With the robot at the west end of the hall."""
    fields: dict[str, Any] = {"body": (12.0, 20.0), "scale": SCALE}
    return Costmap.of(map_, trail, **(fields | changes))


def request(map_: GridMap, **changes: Any) -> PlanRequest:
    fields: dict[str, Any] = {"stamp": 7, "grid": map_, "pose": HERE, "home": (12.0, 20.0)}
    return PlanRequest(**(fields | changes))


def plan(
    map_: GridMap, selection: type[WholeTour] | type[NearestStop] = WholeTour, **changes: Any
) -> Plan:
    return Planner(SCALE, selection(SCALE)).plan(request(map_, **changes))


def straight_plan(
    length: float = 20.0, pose: Pose = MIDDLE, stamp: int = 0, goal: bool = True
) -> Plan:
    """To a frontier straight ahead; home lies straight behind."""
    steps = np.arange(0.5, length, 0.5)
    ahead = np.stack(
        [pose.x + steps * math.cos(pose.yaw), pose.y + steps * math.sin(pose.yaw)], axis=1
    )
    back = 2 * np.array([(pose.x, pose.y)]) - ahead
    speeds = np.full(len(steps), 3.0)
    to = Goal(GoalKind.FRONTIER, float(ahead[-1, 0]), float(ahead[-1, 1])) if goal else None
    path = Path(ahead, speeds) if goal else NO_PATH
    return Plan(stamp, to, path, Path(back, speeds), 10.0, NO_POINTS, 0.5)
