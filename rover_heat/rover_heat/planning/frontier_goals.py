"""From where to look beyond the borders of what is known."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_heat.planning.site import Site
from rover_heat.planning.types import GoalKind, HeatGoal
from rover_navigation.burger_scale import BURGER_SCALE
from rover_navigation.frontiers import Frontier, find_frontiers

Points = NDArray[np.float64]


def frontier_goals(site: Site, pose: Pose, known: Points) -> tuple[list[HeatGoal], Points]:
    """A goal for each border that can be seen from a reachable place, and the middles of all.

    known (n, 3): discs of x, y and radius [m] that were observed already.
    """
    under_body = [(pose.x, pose.y, BURGER_SCALE.blind_radius)]
    frontiers = find_frontiers(site.costmap, np.vstack([known, under_body]), BURGER_SCALE)
    middles = [_middle(frontier) for frontier in frontiers]
    goals = [_goal(site, middle) for middle in middles]
    points = np.array(middles, float).reshape(-1, 2)
    return [goal for goal in goals if goal is not None], points


def _middle(frontier: Frontier) -> tuple[float, float]:
    """[m] The cell nearest to the middle of the border, which itself may lie in a wall."""
    away = np.hypot(frontier.x - frontier.x.mean(), frontier.y - frontier.y.mean())
    nearest = int(np.argmin(away))
    return float(frontier.x[nearest]), float(frontier.y[nearest])


def _goal(site: Site, middle: tuple[float, float]) -> HeatGoal | None:
    """The place reached soonest from which the middle of a border is seen."""
    away = np.hypot(*(site.nodes - middle).T)
    near = np.flatnonzero((away <= BURGER_SCALE.frontier_reach) & np.isfinite(site.seconds))
    ends = np.broadcast_to(np.array(middle), (len(near), 2))
    near = near[site.in_sight(site.nodes[near], ends)]
    if len(near) == 0:
        return None
    near = site.with_room(near)
    # Of places as soon reached, the nearer to the border shows more of what is behind it.
    node = int(near[np.argmin(site.seconds[near] + away[near] / BURGER_SCALE.travel_speed_max)])
    x, y = site.nodes[node]
    yaw = math.atan2(middle[1] - y, middle[0] - x)
    pose = Pose(float(x), float(y), yaw)
    return HeatGoal(GoalKind.FRONTIER, pose, *middle, float(site.seconds[node]))
