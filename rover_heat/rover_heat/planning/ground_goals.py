"""Ground that the robot has never driven on, wide enough for the ramp to lie there."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from rover_common.geometry import Pose
from rover_heat.planning.site import Site
from rover_heat.planning.types import GoalKind, HeatGoal
from rover_heat.ramp.estimate import WIDTH

Points = NDArray[np.float64]
UNTROD = 0.30  # [m] from where the robot has been
# [m] of clearance beside the ramp's middle: half its width and a hand's breadth
CLEARANCE = WIDTH / 2 + 0.05
MOST = 8


def ground_goals(site: Site, trail: Points) -> list[HeatGoal]:
    """Places to drive over, the widest ground first, then the soonest reached; trail (n, 2) [m]."""
    nodes = np.flatnonzero(np.isfinite(site.seconds))
    if len(trail):
        away, _ = KDTree(trail).query(site.nodes[nodes])
        nodes = nodes[away > UNTROD]
    if len(nodes) == 0:
        return []
    row, col = site.geometry.cell_of(*site.nodes[nodes].T)
    clearance = site.costmap.clearance[row, col]
    narrow = clearance < CLEARANCE
    order = np.lexsort((site.seconds[nodes], narrow))
    goals: list[HeatGoal] = []
    for node in nodes[order]:
        x, y = (float(v) for v in site.nodes[node])
        if len(goals) == MOST:
            break
        if all(math.dist((x, y), (goal.x, goal.y)) > 2 * UNTROD for goal in goals):
            pose = Pose(x, y, _heading(site, node))
            goals.append(HeatGoal(GoalKind.GROUND, pose, x, y, float(site.seconds[node])))
    return goals


def _heading(site: Site, node: int) -> float:
    """[rad] As the path arrives there."""
    path = site.roadmap.path(site.paths, 0, int(node))
    x, y = path[-1] - path[max(0, len(path) - 4)]
    return math.atan2(y, x)
