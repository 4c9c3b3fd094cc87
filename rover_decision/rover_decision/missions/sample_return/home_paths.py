"""Paths home: which one is taken, and the next one when the rover makes no progress on it."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np

from rover_common.geometry import Pose, bearing_to
from rover_common.types import PolarArray
from rover_decision.missions.sample_return.explorers import SCAN_TURN, SightDriver
from rover_decision.missions.sample_return.tick import TickContext
from rover_decision.types import Action
from rover_navigation.path_tracking import PathTracker, path_length, remaining
from rover_navigation.types import NO_PATH, Path, Plan

PATIENCE = 20.0  # [s] within which a path must have brought the rover nearer
NEARER = 3.0  # [m]
MAX_STUCK = 2  # times that the rover gets stuck on one path
TURN_ASIDE = math.radians(10.0)  # a free bearing further aside is turned to


class HomePath(Protocol):
    """One method."""

    name: str
    by_breadcrumbs: bool  # whether plans are to make their home path of the trail

    def path(self, plan: Plan | None, pose: Pose) -> Path:
        """The path to drive now; empty when there is none."""


class PlannedHomePath:
    """The home path of the plans, over the breadcrumbs or over the map."""

    def __init__(self, name: str, by_breadcrumbs: bool) -> None:
        self.name = name
        self.by_breadcrumbs = by_breadcrumbs

    def path(self, plan: Plan | None, pose: Pose) -> Path:
        if plan is None or len(plan.home_path) == 0:
            return NO_PATH
        return remaining(plan.home_path, pose)


class HomeByBearing:
    """No path: towards home by sight, whatever the plans say."""

    name = "bearing"
    by_breadcrumbs = False

    def path(self, plan: Plan | None, pose: Pose) -> Path:
        return NO_PATH


METHODS: tuple[HomePath, ...] = (
    PlannedHomePath("breadcrumbs", by_breadcrumbs=True),
    PlannedHomePath("shortest_path", by_breadcrumbs=False),
    HomeByBearing(),
)


class HomePaths:
    """Begins with the preferred method; the others follow when it makes no progress."""

    def __init__(self, preferred: str) -> None:
        self.prefer(preferred, 0.0)

    @property
    def method(self) -> HomePath:
        return METHODS[self.turn % len(METHODS)]

    def prefer(self, name: str, time: float) -> None:
        """Begin anew with this method at a time [s]."""
        self.turn = [method.name for method in METHODS].index(name)
        self._stuck = 0
        self.begin(time)

    def begin(self, time: float) -> None:
        """Set out, or go on after an interruption: the clock starts anew."""
        self._best, self._since = math.inf, time

    def got_stuck(self) -> None:
        """On the path in force, which is left when that happens again."""
        self._stuck += 1
        if self._stuck >= MAX_STUCK:
            self._next()

    def update(self, time: float, pose: Pose, home: tuple[float, float], plan: Plan | None) -> None:
        """Take the next method when the rover has come no nearer for too long."""
        path = self.method.path(plan, pose)
        left = path_length(path, pose) if len(path) else math.dist(home, (pose.x, pose.y))
        if left < self._best - NEARER:
            self._best, self._since = left, time
        if time - self._since > PATIENCE:
            self._next()
            self.begin(time)

    def _next(self) -> None:
        self.turn += 1
        self._stuck = 0


class HomewardDriver:
    """Drives along a home path, or by sight where there is none."""

    def __init__(
        self, tracker: PathTracker, sight: SightDriver, stop_clearance: float, go_clearance: float
    ) -> None:
        self._tracker = tracker
        self._sight = sight
        self._stop_clearance = stop_clearance
        self._go_clearance = go_clearance

    def drive(self, tick: TickContext, method: HomePath, home: tuple[float, float]) -> Action:
        """Towards home [m] by this method."""
        reason = f"goes home by {method.name}"
        path = method.path(tick.plan, tick.pose)
        if len(path) > 0:
            return self._tracker.command(tick.pose, tick.speed, path, tick.local), reason
        bearing = bearing_home(tick.frame.nav, tick.pose, home)
        turn_in_place = self._sight.actuation.turn_in_place
        if bearing is None:
            return turn_in_place(tick.speed, SCAN_TURN), f"{reason}: turns in search of ground"
        if tick.local.clearance(bearing) < self._stop_clearance:
            around = tick.local.best_bearing(bearing, self._go_clearance)
            turn = around if abs(around) > TURN_ASIDE else SCAN_TURN
            return turn_in_place(tick.speed, turn), f"{reason}: turns"
        return self._sight.towards(tick, bearing), reason


def bearing_home(nav: PolarArray, pose: Pose, home: tuple[float, float]) -> float | None:
    """Of the middle half of the navigable bearings, the one [rad] closest to home's."""
    if len(nav.bearings) == 0:
        return None
    low, high = np.percentile(nav.bearings, (25, 75))
    return float(np.clip(bearing_to(pose, *home), low, high))
