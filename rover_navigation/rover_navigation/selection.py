"""Which of the stops to go to first: the strategies by which an explorer plans."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, bearing_to
from rover_navigation.roadmap import Roadmap, ShortestPaths
from rover_navigation.scale import Scale
from rover_navigation.tour import tour_costs
from rover_navigation.types import Goal, PlanRequest

LOYALTY = 4.0  # [s] that another goal must save before the robot turns to it
SHARP = math.radians(60.0)  # a turn that is made in place
AHEAD = 5  # points of a path that decide on the turn towards it


@dataclass(frozen=True)
class Stop:
    """A goal, and the node to go to for it."""

    goal: Goal
    node: int
    worth: float = math.inf  # [s] that it may take


class Selection(Protocol):
    """A strategy."""

    def first(
        self,
        request: PlanRequest,
        roadmap: Roadmap,
        paths: ShortestPaths,
        stops: list[Stop],
        home: int,
    ) -> Stop | None:
        """The stop to go to first; None when none is worth the time.

        `paths` lead from the robot, `home` is the node of the start, -1 where it is out of reach.
        """


class NearestStop:
    """The stop that is reached soonest."""

    def __init__(self, scale: Scale) -> None:
        self._scale = scale

    def first(
        self,
        request: PlanRequest,
        roadmap: Roadmap,
        paths: ShortestPaths,
        stops: list[Stop],
        home: int,
    ) -> Stop | None:
        if not stops:
            return None
        cost = _seconds_to(request.pose, roadmap, paths, stops, self._scale)
        return _cheapest(stops, cost, request.last_goal, self._scale)


class WholeTour:
    """The first stop of the tour over all of them that ends at home soonest."""

    def __init__(self, scale: Scale) -> None:
        self._scale = scale

    def first(
        self,
        request: PlanRequest,
        roadmap: Roadmap,
        paths: ShortestPaths,
        stops: list[Stop],
        home: int,
    ) -> Stop | None:
        if not stops:
            return None
        nodes = [stop.node for stop in stops]
        first = _seconds_to(request.pose, roadmap, paths, stops, self._scale)
        ends = [home] if home >= 0 else []
        between = roadmap.seconds_between(paths, nodes + ends)
        # The way home takes as long as the way from home.
        last = between[: len(nodes), -1] if home >= 0 else np.zeros(len(stops))
        between = between[: len(nodes), : len(nodes)]
        worth = np.array([stop.worth for stop in stops])
        cost = tour_costs(first, between, last, worth)
        at_once = float(paths.seconds[0, home]) if home >= 0 else 0.0
        if worth.sum() + at_once < cost.min():
            return None
        return _cheapest(stops, cost, request.last_goal, self._scale)


def _seconds_to(
    pose: Pose, roadmap: Roadmap, paths: ShortestPaths, stops: list[Stop], scale: Scale
) -> NDArray[np.float64]:
    """(n,) [s] from the robot to each stop, the turn towards it included."""
    nodes = [stop.node for stop in stops]
    turns = [_turn_seconds(pose, roadmap.path(paths, 0, node), scale) for node in nodes]
    return np.asarray(paths.seconds[0, nodes] + turns)


def _turn_seconds(pose: Pose, path: NDArray[np.float64], scale: Scale) -> float:
    """To turn towards a path, when that takes a turn in place."""
    x, y = path[min(len(path) - 1, AHEAD)]
    if math.hypot(x - pose.x, y - pose.y) < 0.5:
        return 0.0
    angle = abs(bearing_to(pose, x, y))
    return angle / scale.turn_rate + (scale.turn_seconds if angle > SHARP else 0.0)


def _cheapest(
    stops: list[Stop], cost: NDArray[np.float64], last: Goal | None, scale: Scale
) -> Stop:
    same = np.array([_same(stop.goal, last, scale.same_goal) for stop in stops])
    return stops[int(np.argmin(cost - LOYALTY * same))]


def _same(goal: Goal, last: Goal | None, distance: float) -> bool:
    if last is None or goal.kind is not last.kind:
        return False
    return math.hypot(goal.x - last.x, goal.y - last.y) < distance
