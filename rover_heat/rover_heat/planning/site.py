"""The map of one request: what is ground, what is wall, and what can be reached."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.map_encoding import FREE_BELOW, UNKNOWN
from rover_common.types import GridMap
from rover_heat.planning.types import HeatPlanRequest
from rover_navigation.burger_scale import BURGER_SCALE
from rover_navigation.costmap import Costmap
from rover_navigation.region import Region
from rover_navigation.roadmap import Roadmap, ShortestPaths
from rover_navigation.types import NO_POINTS

Points = NDArray[np.float64]
SAMPLE = 0.04  # [m] along a line of sight: less than a cell
# [m] from obstacles, of places to drive to: more than on the way there, for the robot turns at them
ROOM = 0.20
BORDER = 4  # [cells]


@dataclass(frozen=True)
class Site:
    """`costmap` has the hazards in it as obstacles, `walls` (rows, cols) are true ones."""

    costmap: Costmap
    walls: NDArray[np.bool_]
    roadmap: Roadmap
    paths: ShortestPaths  # from the robot
    reachable: Region
    placed: bool

    @property
    def geometry(self) -> GridGeometry:
        return self.costmap.geometry

    @property
    def seconds(self) -> NDArray[np.float64]:
        """(nodes,) [s] to get there."""
        return np.asarray(self.paths.seconds[0])

    @property
    def nodes(self) -> Points:
        """(nodes, 2) [m]"""
        return np.stack([self.roadmap.x, self.roadmap.y], axis=1)

    def with_room(self, nodes: NDArray[np.intp]) -> NDArray[np.intp]:
        """Those of some nodes where there is room to turn; all of them where there is nowhere."""
        row, col = self.geometry.cell_of(*self.nodes[nodes].T)
        wide = nodes[self.costmap.clearance[row, col] >= ROOM]
        return wide if len(wide) else nodes

    def seconds_to(self, x: float, y: float, reach: float) -> float:
        """[s] to the node nearest to a place, inf when none is within reach [m]."""
        node = self.reachable.node_at((x, y), reach)
        return float(self.seconds[node]) if node >= 0 else math.inf

    def in_sight(self, starts: Points, ends: Points) -> NDArray[np.bool_]:
        """(n,) Whether no wall and nothing unknown lies between points (n, 2) [m]."""
        if len(starts) == 0:
            return np.zeros(0, bool)
        longest = float(np.hypot(*(ends - starts).T).max())
        share = np.linspace(0.0, 1.0, max(2, math.ceil(longest / SAMPLE) + 1))[:, None]
        x = starts[:, 0] + share * (ends - starts)[:, 0]
        y = starts[:, 1] + share * (ends - starts)[:, 1]
        row, col = self.geometry.nearest_cell_to(x, y)
        blocked = self.walls | self.costmap.unknown
        return np.asarray(~blocked[row, col].any(axis=0))


def make_site(request: HeatPlanRequest, padding: int) -> Site:
    """padding: [cells] of obstacles beyond their own."""
    scale = BURGER_SCALE
    body = (request.pose.x, request.pose.y)
    grid = _bordered(request.grid)
    plain = Costmap.of(grid, NO_POINTS, body, scale)
    blocked = request.hazards.drawn_into(_padded(grid, padding))
    costmap = Costmap.of(blocked, NO_POINTS, body, scale)
    roadmap = Roadmap(costmap, scale)
    start = _start_node(roadmap, plain, request.pose)
    if start < 0:
        paths = ShortestPaths(np.full((1, len(roadmap)), np.inf), np.empty((1, 0), np.int32))
    else:
        paths = roadmap.shortest_paths([start])
    walls = ~plain.free & ~plain.unknown
    reachable = Region(roadmap, np.isfinite(paths.seconds[0]), scale.wide_reach)
    return Site(costmap, walls, roadmap, paths, reachable, placed=start >= 0)


def _start_node(roadmap: Roadmap, plain: Costmap, pose: Pose) -> int:
    """The drivable node nearest to the robot, with no wall in between."""
    x, y = roadmap.x - pose.x, roadmap.y - pose.y
    away = np.hypot(x, y)
    near = np.flatnonzero(away <= BURGER_SCALE.body_reach)
    share = np.linspace(0.0, 1.0, 25)[:, None]
    row, col = plain.geometry.nearest_cell_to(pose.x + share * x[near], pose.y + share * y[near])
    wall = ~plain.free & ~plain.unknown
    near = near[~wall[row, col].any(axis=0)]
    return int(near[np.argmin(away[near])]) if len(near) else -1


def _bordered(grid: GridMap) -> GridMap:
    """The map with unknown cells around it: ground at its very edge borders on the unknown too."""
    size = BORDER * grid.resolution
    cells = np.pad(grid.cells, BORDER, constant_values=UNKNOWN)
    return GridMap(grid.resolution, grid.origin_x - size, grid.origin_y - size, cells)


def _padded(grid: GridMap, padding: int) -> GridMap:
    """The map with its occupied cells grown."""
    if padding == 0:
        return grid
    size = 2 * padding + 1
    occupied = (grid.cells >= FREE_BELOW).astype(np.uint8)
    grown = cv2.dilate(occupied, np.ones((size, size), np.uint8)) > 0
    cells = np.where(grown & (grid.cells >= 0), np.int8(100), grid.cells)
    return GridMap(grid.resolution, grid.origin_x, grid.origin_y, cells)
