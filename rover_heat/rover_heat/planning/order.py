"""In which order to drive to goals: so that all of them are seen soonest."""

from __future__ import annotations

import numpy as np

from rover_heat.planning.site import Site
from rover_heat.planning.types import LOOK_SECONDS, HeatGoal
from rover_navigation.tour import MOST_STOPS, tour_costs


def in_order(site: Site, goals: list[HeatGoal]) -> list[HeatGoal]:
    """The goals by what the tour over the nearest of them takes that begins with each."""
    goals = sorted(goals, key=lambda goal: goal.seconds)
    near, rest = goals[:MOST_STOPS], goals[MOST_STOPS:]
    if len(near) < 2:
        return goals
    nodes = [site.reachable.node_at((goal.pose.x, goal.pose.y), REACH) for goal in near]
    first = np.array([goal.seconds for goal in near])
    between = site.roadmap.seconds_from(nodes)[:, nodes] + LOOK_SECONDS
    cost = tour_costs(first, between, np.zeros(len(near)), np.full(len(near), np.inf))
    return [near[int(i)] for i in np.argsort(cost, kind="stable")] + rest


REACH = 0.05  # [m] a goal stands on a node
