"""One plan: sources out of fixes, what is left to see, and how long it takes to get there."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_heat.config import HeatConfig
from rover_heat.planning.faces import Faces, find_faces
from rover_heat.planning.frontier_goals import frontier_goals
from rover_heat.planning.ground_goals import ground_goals
from rover_heat.planning.order import in_order
from rover_heat.planning.site import Site, make_site
from rover_heat.planning.stand_off import approach, stand_offs
from rover_heat.planning.types import HeatGoal, HeatPlan, HeatPlanRequest
from rover_heat.planning.view_goals import Sights, find_sights, view_goals
from rover_heat.thermal.sources import find_sources, find_suspects
from rover_navigation.frontiers import in_discs

START_REACH, GOAL_REACH = 0.3, 0.2  # [m] to the nearest drivable cell


class HeatPlanner:
    """Stateless: the same request gives the same plan."""

    def __init__(self, config: HeatConfig) -> None:
        self._config = config

    def plan(self, request: HeatPlanRequest) -> HeatPlan:
        """The plan for a request."""
        config = self._config
        sources = find_sources(request.fixes, config)
        site = make_site(request, config.padding if config.use_padding else 0)
        if not site.placed:
            return HeatPlan(request.stamp, placed=False, sources=sources)
        frontiers, middles = frontier_goals(site, request.pose, request.known)
        suspects = find_suspects(request.fixes, sources, config)
        faces = find_faces(site, request.examined, suspects)
        sights = find_sights(site, faces)
        views = self._views(request, site, faces, sights)
        goals = in_order(site, [*frontiers, *views])
        if request.seek_ramp:
            goals = ground_goals(site, request.trail)
        failed = _failed(goals, request.failed)
        start, goal = request.start or request.pose, request.goal or request.pose
        return HeatPlan(
            stamp=request.stamp,
            goals=tuple(g for g, bad in zip(goals, failed, strict=True) if not bad),
            waiting=tuple(g for g, bad in zip(goals, failed, strict=True) if bad),
            goal_seconds=site.seconds_to(goal.x, goal.y, GOAL_REACH),
            sources=sources,
            suspects=suspects,
            stand_offs=tuple(stand_offs(site, source, config) for source in sources),
            approaches=tuple(approach(site, ramp) for ramp in request.ramps),
            start_seconds=site.seconds_to(start.x, start.y, START_REACH),
            frontiers=middles,
            faces=faces.points[faces.examined],
            open_faces=faces.points[~faces.examined & _reachable(faces, sights)],
            explored=_explored(faces, sights),
        )

    def _views(
        self, request: HeatPlanRequest, site: Site, faces: Faces, sights: Sights
    ) -> list[HeatGoal]:
        if self._config.fast_explore:
            return []
        return view_goals(site, faces, sights, request.pose, request.sensors, self._config)


def _failed(goals: list[HeatGoal], discs: NDArray[np.float64]) -> list[bool]:
    """Whether the place that each goal is about lies in one of the discs (n, 3) [m]."""
    if not goals:
        return []
    x, y = np.array([(goal.x, goal.y) for goal in goals]).T
    return in_discs(x, y, discs).tolist()


def _reachable(faces: Faces, sights: Sights) -> NDArray[np.bool_]:
    """Faces that some place shows."""
    reachable = np.zeros(len(faces.points), bool)
    reachable[sights.face] = True
    return reachable


def _explored(faces: Faces, sights: Sights) -> float:
    reachable = _reachable(faces, sights) | faces.examined
    count = int(np.count_nonzero(reachable))
    return float(np.count_nonzero(faces.examined)) / count if count else math.nan
