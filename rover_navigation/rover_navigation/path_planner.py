"""The path of a robot that turns in place, from where it stands to a goal on its map."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.types import GridMap
from rover_navigation.costmap import Costmap
from rover_navigation.hazards import Hazards, occupied_at
from rover_navigation.path_smoothing import smooth_path
from rover_navigation.region import Region
from rover_navigation.roadmap import Roadmap
from rover_navigation.scale import Scale
from rover_navigation.types import NO_POINTS

LINE_SAMPLES = 25  # on the line to a drivable cell, of up to half a metre


class Ground:
    """One map, as far as paths need it; immutable."""

    def __init__(self, grid: GridMap, hazards: Hazards, body: Pose, scale: Scale) -> None:
        """body: where the robot stands."""
        self._scale = scale
        self._walls = grid
        self.costmap = Costmap.of(hazards.drawn_into(grid), NO_POINTS, (body.x, body.y), scale)

    @cached_property
    def _roadmap(self) -> Roadmap:
        return Roadmap(self.costmap, self._scale)

    def refusal(self, goal: Pose, tolerance: float) -> str:
        """Why nothing can drive to a goal, within `tolerance` [m] of it; empty where it can."""
        if not all(map(math.isfinite, (goal.x, goal.y, goal.yaw, tolerance))):
            return "the goal is not a number"
        if tolerance <= 0.0:
            return "the tolerance is not positive"
        costmap = self.costmap
        row, col = (int(i) for i in costmap.geometry.cell_of(goal.x, goal.y))
        if not costmap.geometry.contains(row, col):
            return "the goal is out of the map"
        if costmap.unknown[row, col]:
            return "the goal is in unknown cells"
        if not costmap.free[row, col]:
            return "the goal is in a wall"
        if self._goal_node(goal, tolerance) < 0:
            return "the goal is too near to a wall"
        return ""

    def path(self, start: Pose, goal: Pose, tolerance: float) -> NDArray[np.float64]:
        """Points (n, 2) [m] from the robot to the goal; empty where there is no path."""
        roadmap = self._roadmap
        first, last = self._start_node(start), self._goal_node(goal, tolerance)
        if first < 0 or last < 0:
            return NO_POINTS
        paths = roadmap.shortest_paths([first])
        if not math.isfinite(paths.seconds[0, last]):
            return NO_POINTS
        points = roadmap.path(paths, 0, last)
        points[0] = (start.x, start.y)
        if math.dist(points[-1], (goal.x, goal.y)) < self.costmap.geometry.resolution:
            points = np.concatenate([points, [[goal.x, goal.y]]])
        return smooth_path(points, self.costmap, self._scale).points

    def _start_node(self, start: Pose) -> int:
        """The nearest drivable cell in sight: a robot in inflated cells or on a hazard leaves them,
        and never through a wall; -1 where there is none in reach."""
        x, y = self._roadmap.x - start.x, self._roadmap.y - start.y
        away = np.hypot(x, y)
        near = np.flatnonzero(away <= self._scale.body_reach)
        share = np.linspace(0.0, 1.0, LINE_SAMPLES)[:, None]
        hidden = occupied_at(self._walls, start.x + share * x[near], start.y + share * y[near])
        near = near[~hidden.any(axis=0)]
        return int(near[np.argmin(away[near])]) if len(near) else -1

    def _goal_node(self, goal: Pose, tolerance: float) -> int:
        reach = max(tolerance, self.costmap.geometry.resolution)
        everywhere = Region.everywhere(self._roadmap, self._scale.wide_reach)
        return everywhere.node_at((goal.x, goal.y), reach)
