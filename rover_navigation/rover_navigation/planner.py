"""One plan: from the map, the rocks and the pose to the next goal and the way there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, wrap_angle
from rover_common.vehicle import MAX_STEERING, TURN_IN_PLACE_RATE
from rover_navigation.breadcrumb_path import way_over_crumbs
from rover_navigation.costmap import Costmap
from rover_navigation.coverage import hiding_places
from rover_navigation.frontiers import Frontier, find_frontiers, near_visited
from rover_navigation.path_smoothing import drivable_way
from rover_navigation.region import Region
from rover_navigation.roadmap import Roadmap, Ways
from rover_navigation.tour import MOST_STOPS, tour_costs
from rover_navigation.types import (
    NO_WAY,
    Goal,
    GoalKind,
    Plan,
    PlanRequest,
)

REACH_FROM_BODY = 3.0  # [m] to the nearest drivable cell, from where the rover or its home is
REACH_OF_FRONTIER = 10.0  # [m] from the place to look at it from
REACH_OF_ROCK = 2.5  # [m] from the end of the way, where the approach by sight takes over
SAME_GOAL = 4.0  # [m] a goal this near to the last one is the same, seen anew
LOYALTY = 4.0  # [s] that another goal must save before the rover turns to it
TURN_SECONDS = 2.0  # [s] to stop for a turn on the spot, and to gather speed again
SHARP = math.radians(60.0)  # a turn that is made on the spot
# [m] A rock in the open shows from the first on in every look, one half buried or behind the swell
# of a wall's foot from the second on.
SEARCH_DISTANCES = (5.0, 3.0)
# What little ground a frontier may hide is worth this detour: a canyon's ground takes about a
# quarter of it.
SECONDS_PER_AREA = 1.5  # [s/m^2]
STOP_SECONDS = 3.0  # to brake, turn and gather speed again, which the ways do not count
DOUBTFUL_SECONDS = 8.0  # [s] of detour to look again at what was looked at in vain
MOST_SMALL = 4  # stops of limited worth that are considered
UNKNOWN_DEPTH = 8.0  # [m] of ground guessed behind each metre of a frontier


@dataclass(frozen=True)
class _Stop:
    goal: Goal
    node: int
    worth: float = math.inf  # [s] that it may take


class Planner:
    """Stateless: the same request gives the same plan."""

    def __init__(self, explorer: str) -> None:
        """explorer: tour (all stops in the best order) or frontier (the nearest)."""
        self._whole_tour = explorer != "frontier"

    def plan(self, request: PlanRequest) -> Plan:
        """The plan for a request; its goal is None when nothing is left to do out there."""
        pose = request.pose
        costmap = Costmap.of(request.grid, request.trail, (pose.x, pose.y), request.blocked)
        roadmap = Roadmap(costmap)
        frontiers = find_frontiers(costmap, request.visited)
        start = Region.everywhere(roadmap).node_at((pose.x, pose.y), REACH_FROM_BODY)
        if start < 0:
            return Plan(
                request.stamp,
                None,
                NO_WAY,
                NO_WAY,
                math.inf,
                _centers(frontiers),
                _explored(costmap, frontiers),
                placed=False,
            )
        ways = roadmap.ways_from([start])
        reachable = Region(roadmap, np.isfinite(ways.seconds[0]))
        home = reachable.node_at(request.home, REACH_FROM_BODY)
        stops = self._stops(request, reachable, ways.seconds[0], frontiers)
        goal_way, goal = NO_WAY, None
        best = self._choose(request, roadmap, ways, stops, home)
        if best is None and request.search:
            best = _search(request, costmap, reachable, ways.seconds[0])
        if best is not None:
            goal, goal_way = best.goal, drivable_way(roadmap.way(ways, 0, best.node), costmap)
        home_way, home_seconds = NO_WAY, math.inf
        if home >= 0:
            home_way = drivable_way(roadmap.way(ways, 0, home), costmap)
            home_seconds = float(ways.seconds[0, home])
        if request.home_by_crumbs:
            crumbs = way_over_crumbs(request.trail, (pose.x, pose.y), costmap)
            home_way = drivable_way(crumbs, costmap)
        explored = _explored(costmap, frontiers)
        return Plan(
            request.stamp, goal, goal_way, home_way, home_seconds, _centers(frontiers), explored
        )

    def _stops(
        self,
        request: PlanRequest,
        reachable: Region,
        seconds: NDArray[np.float64],
        frontiers: list[Frontier],
    ) -> list[_Stop]:
        """The nearest of what is left: rocks and frontiers; `seconds` (nodes,) to get there."""
        found: list[_Stop] = []
        for rock in request.rocks:
            node = _node_near(reachable, (rock.x, rock.y), REACH_OF_ROCK)
            found.append(_Stop(Goal(GoalKind.ROCK, rock.x, rock.y, rock.id), node))
        for frontier in frontiers:
            nodes = reachable.nodes_near(frontier.x, frontier.y, REACH_OF_FRONTIER)
            cost = np.where(nodes >= 0, seconds[nodes], np.inf)
            nearest = int(np.argmin(cost))
            x, y = float(frontier.x[nearest]), float(frontier.y[nearest])
            worth = SECONDS_PER_AREA * frontier.hides - STOP_SECONDS
            if near_visited(frontier.x, frontier.y, request.doubtful).any():
                worth = min(worth, DOUBTFUL_SECONDS)
            found.append(_Stop(Goal(GoalKind.FRONTIER, x, y), int(nodes[nearest]), worth))
        found = [stop for stop in found if stop.node >= 0]
        large = [stop for stop in found if math.isinf(stop.worth)]
        large = sorted(large, key=lambda stop: float(seconds[stop.node]))
        small = [stop for stop in found if 0.0 < stop.worth < math.inf]
        small = sorted(small, key=lambda stop: float(seconds[stop.node]) - stop.worth)[:MOST_SMALL]
        return large[: MOST_STOPS - len(small)] + small

    def _choose(
        self, request: PlanRequest, roadmap: Roadmap, ways: Ways, stops: list[_Stop], home: int
    ) -> _Stop | None:
        """The stop to go to first; None when none is worth the time."""
        if not stops:
            return None
        nodes = [stop.node for stop in stops]
        first = ways.seconds[0, nodes] + [
            _turn_seconds(request.pose, roadmap.way(ways, 0, node)) for node in nodes
        ]
        if self._whole_tour:
            onward = roadmap.ways_from(nodes).seconds
            last = onward[:, home] if home >= 0 else np.zeros(len(stops))
            worth = np.array([stop.worth for stop in stops])
            cost = tour_costs(first, onward[:, nodes], last, worth)
            at_once = float(ways.seconds[0, home]) if home >= 0 else 0.0
            if worth.sum() + at_once < cost.min():
                return None
        else:
            cost = first
        cost = cost - LOYALTY * np.array([_same(stop.goal, request.last_goal) for stop in stops])
        return stops[int(np.argmin(cost))]


def _node_near(reachable: Region, point: tuple[float, float], reach: float) -> int:
    """The node nearest to a point [m]; -1 where none is within `reach` [m]."""
    return int(reachable.nodes_near(np.array([point[0]]), np.array([point[1]]), reach)[0])


def _search(
    request: PlanRequest, costmap: Costmap, reachable: Region, seconds: NDArray[np.float64]
) -> _Stop | None:
    """The nearest place that was not looked at from near, or else from nearer still."""
    if request.searched is None:
        return None
    x, y, looked_from = hiding_places(request.searched, costmap)
    nodes = reachable.nodes_near(x, y, REACH_OF_ROCK)
    cost = np.where(nodes >= 0, seconds[nodes], np.inf)
    cost[near_visited(x, y, request.visited)] = np.inf
    for distance in SEARCH_DISTANCES:
        left = np.where(looked_from > distance, cost, np.inf)
        if np.isfinite(left).any():
            nearest = int(np.argmin(left))
            goal = Goal(GoalKind.SEARCH, float(x[nearest]), float(y[nearest]))
            return _Stop(goal, int(nodes[nearest]))
    return None


def _turn_seconds(pose: Pose, way: NDArray[np.float64]) -> float:
    """To turn towards a way, when that takes a turn on the spot."""
    ahead = way[min(len(way) - 1, 5)]
    if math.hypot(ahead[0] - pose.x, ahead[1] - pose.y) < 0.5:
        return 0.0
    angle = abs(wrap_angle(math.atan2(ahead[1] - pose.y, ahead[0] - pose.x) - pose.yaw))
    return angle / (TURN_IN_PLACE_RATE * MAX_STEERING) + (TURN_SECONDS if angle > SHARP else 0.0)


def _same(goal: Goal, last: Goal | None) -> bool:
    if last is None or goal.kind is not last.kind:
        return False
    return math.hypot(goal.x - last.x, goal.y - last.y) < SAME_GOAL


def _centers(frontiers: Sequence[Frontier]) -> NDArray[np.float64]:
    return np.array([(f.x.mean(), f.y.mean()) for f in frontiers], float).reshape(-1, 2)


def _explored(costmap: Costmap, frontiers: list[Frontier]) -> float:
    """Share of the ground that is known, guessing that each frontier opens on some more."""
    resolution = costmap.geometry.resolution
    known = float(np.count_nonzero(costmap.free)) * resolution**2
    beyond = sum(f.length for f in frontiers) * resolution * UNKNOWN_DEPTH
    return known / (known + beyond) if known else 0.0
