"""One plan: from the map, the targets and the pose to the next goal and the path there."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.types import GridMap
from rover_navigation.breadcrumb_path import breadcrumb_path
from rover_navigation.costmap import Costmap
from rover_navigation.coverage import unsearched_cells
from rover_navigation.frontiers import Frontier, find_frontiers, in_discs
from rover_navigation.mapped_share import mapped_share
from rover_navigation.path_smoothing import smooth_path
from rover_navigation.plan_layers import PlanLayers
from rover_navigation.region import Region
from rover_navigation.roadmap import Roadmap, ShortestPaths
from rover_navigation.scale import Scale
from rover_navigation.selection import Selection, Stop
from rover_navigation.tour import MOST_STOPS
from rover_navigation.types import NO_PATH, Goal, GoalKind, Path, Plan, PlanRequest

RETRY_SECONDS = 8.0  # [s] of detour that a goal is worth which was observed without result before
MOST_SMALL = 4  # stops of limited worth that are considered


@dataclass(frozen=True)
class _Site:
    """The map of one request, and what can be reached on it."""

    costmap: Costmap
    roadmap: Roadmap
    paths: ShortestPaths  # from the robot
    reachable: Region

    @property
    def seconds(self) -> NDArray[np.float64]:
        """(nodes,) [s] to get there."""
        return np.asarray(self.paths.seconds[0])

    def path_to(self, node: int) -> NDArray[np.float64]:
        """(n, 2) [m]"""
        return self.roadmap.path(self.paths, 0, node)


class Planner:
    """The same request gives the same plan, whatever was planned before."""

    def __init__(
        self, scale: Scale, selection: Selection, truth: NDArray[np.bool_] | None = None
    ) -> None:
        """selection: which of the stops comes first; truth: navigable cells (rows, cols), if known.

        The truth counts for nothing but the share that is explored.
        """
        self._truth = truth
        self._scale = scale
        self._selection = selection
        self._layers: PlanLayers | None = None  # those of the last plan, to go on with

    def plan(self, request: PlanRequest) -> Plan:
        """The plan for a request; its goal is None when nothing is left to do out there."""
        # Each plan owns the layers while it is made: one that fails, or that hangs in a thread that
        # was given up, leaves none, and the next plan begins with new ones.
        layers, self._layers = self._layers or PlanLayers(self._scale), None
        plan = self._plan(request, layers)
        self._layers = layers
        return plan

    def _plan(self, request: PlanRequest, layers: PlanLayers) -> Plan:
        body = (request.pose.x, request.pose.y)
        layers.update(request)
        costmap = layers.costmap
        frontiers = find_frontiers(costmap, request.blacklisted, self._scale, layers.borders)
        centers = _centers(frontiers)
        explored = self._explored(request.grid, costmap, frontiers)
        roadmap = layers.roadmap
        everywhere = Region.everywhere(roadmap, self._scale.wide_reach)
        start = everywhere.node_at(body, self._scale.body_reach)
        if start < 0:
            return Plan(
                request.stamp, None, NO_PATH, NO_PATH, math.inf, centers, explored, placed=False
            )
        paths = roadmap.shortest_paths([start])
        there = np.isfinite(paths.seconds[0])
        reachable = Region(roadmap, there, self._scale.wide_reach, layers.nearest)
        site = _Site(costmap, roadmap, paths, reachable)
        home = reachable.node_at(request.home, self._scale.body_reach)
        goal, path = self._next_goal(request, site, frontiers, home)
        home_seconds = float(site.seconds[home]) if home >= 0 else math.inf
        home_path = self._home_path(request, site, home)
        return Plan(request.stamp, goal, path, home_path, home_seconds, centers, explored)

    def _explored(self, grid: GridMap, costmap: Costmap, frontiers: list[Frontier]) -> float:
        """Share of the truth that is mapped, or what the map's borders imply."""
        if self._truth is not None:
            return mapped_share(grid, self._truth)
        return _explored(costmap, frontiers, self._scale.unknown_depth)

    def _next_goal(
        self, request: PlanRequest, site: _Site, frontiers: list[Frontier], home: int
    ) -> tuple[Goal | None, Path]:
        """The stop to go to first and the path there; None when none is worth the time."""
        stops = self._nearest_stops(request, site, frontiers)
        best = self._selection.first(request, site.roadmap, site.paths, stops, home)
        if best is None and request.search:
            best = self._search(request, site)
        if best is None:
            return None, NO_PATH
        return best.goal, smooth_path(site.path_to(best.node), site.costmap, self._scale)

    def _home_path(self, request: PlanRequest, site: _Site, home: int) -> Path:
        if request.home_by_breadcrumbs:
            body = (request.pose.x, request.pose.y)
            points = breadcrumb_path(request.trail, body, site.costmap, self._scale)
        elif home >= 0:
            points = site.path_to(home)
        else:
            return NO_PATH
        return smooth_path(points, site.costmap, self._scale)

    def _nearest_stops(
        self, request: PlanRequest, site: _Site, frontiers: list[Frontier]
    ) -> list[Stop]:
        """The nearest of what is left: targets and frontiers."""
        found = [
            Stop(
                Goal(GoalKind.TARGET, target.x, target.y, target.id),
                _node_near(site.reachable, (target.x, target.y), target.reach),
                target.worth,
            )
            for target in request.targets
        ]
        found += self._frontier_stops(frontiers, request, site)
        found = [stop for stop in found if stop.node >= 0]
        large = [stop for stop in found if math.isinf(stop.worth)]
        large = sorted(large, key=lambda stop: float(site.seconds[stop.node]))
        small = [stop for stop in found if 0.0 < stop.worth < math.inf]
        small = sorted(small, key=lambda stop: float(site.seconds[stop.node]) - stop.worth)
        small = small[:MOST_SMALL]
        return large[: MOST_STOPS - len(small)] + small

    def _frontier_stops(
        self, frontiers: list[Frontier], request: PlanRequest, site: _Site
    ) -> list[Stop]:
        """Where each frontier is observed from soonest, and what that is worth."""
        if not frontiers:
            return []
        scale = self._scale
        x, y = (np.concatenate([getattr(f, axis) for f in frontiers]) for axis in "xy")
        nodes = site.reachable.nodes_near(x, y, scale.frontier_reach)
        cost = np.where(nodes >= 0, site.seconds[nodes], np.inf)
        observed = in_discs(x, y, request.retryable)
        stops, first = [], 0
        for frontier in frontiers:
            own = slice(first, first + frontier.length)
            nearest = own.start + int(np.argmin(cost[own]))
            goal = Goal(GoalKind.FRONTIER, float(x[nearest]), float(y[nearest]))
            # A frontier onto unbounded unknown space is worth any detour.
            worth = scale.seconds_per_area * frontier.hidden_area(scale) - scale.stop_seconds
            if observed[own].any():
                worth = min(worth, RETRY_SECONDS)
            stops.append(Stop(goal, int(nodes[nearest]), worth))
            first = own.stop
        return stops

    def _search(self, request: PlanRequest, site: _Site) -> Stop | None:
        """The nearest cell that was not observed from near, or else from nearer still."""
        if request.coverage is None:
            return None
        scale = self._scale
        x, y, observed_from = unsearched_cells(request.coverage, site.costmap, scale.base_reach)
        nodes = site.reachable.nodes_near(x, y, scale.target_reach)
        cost = np.where(nodes >= 0, site.seconds[nodes], np.inf)
        cost[in_discs(x, y, request.blacklisted)] = np.inf
        for distance in scale.search_distances:
            left = np.where(observed_from > distance, cost, np.inf)
            if np.isfinite(left).any():
                nearest = int(np.argmin(left))
                goal = Goal(GoalKind.SEARCH, float(x[nearest]), float(y[nearest]))
                return Stop(goal, int(nodes[nearest]))
        return None


def _node_near(reachable: Region, point: tuple[float, float], reach: float) -> int:
    """The node nearest to a point [m]; -1 where none is within `reach` [m]."""
    return int(reachable.nodes_near(np.array([point[0]]), np.array([point[1]]), reach)[0])


def _centers(frontiers: list[Frontier]) -> NDArray[np.float64]:
    return np.array([(f.x.mean(), f.y.mean()) for f in frontiers], float).reshape(-1, 2)


def _explored(costmap: Costmap, frontiers: list[Frontier], unknown_depth: float) -> float:
    """Share of the ground that is known, guessing that each frontier opens on some more."""
    resolution = costmap.geometry.resolution
    known = float(np.count_nonzero(costmap.free)) * resolution**2
    beyond = sum(f.length for f in frontiers) * resolution * unknown_depth
    return known / (known + beyond) if known else 0.0
