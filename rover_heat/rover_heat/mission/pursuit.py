"""The goals of the plans, one after the other: which is driven to, and when it is done with."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial import KDTree

from rover_common.geometry import Pose, distance_between
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.tick import HeatTick
from rover_heat.mission.trip import TripStatus
from rover_heat.planning.faces import SUSPECT
from rover_heat.planning.types import GoalKind, HeatGoal, HeatPlan, Points, worth_of

TOLERANCE = 0.10  # [m]
LOOK, LOOK_FRAMES = 0.7, 3.0  # [s] at a view's pose, and periods of a thermal sensor
SAME = 0.3  # [m] a goal this near to another one is the same, seen anew
BETTER = 2.0  # times as much per second shows a goal that is turned to on the way
LEFT = 0.25  # of a view's faces: with fewer it need not be driven to
WARM_LOOK = 0.7  # [s] longer, for more fixes of what is warm
SEEN = 0.95  # of its faces: with so many it need not look longer
SAME_FACE = 0.03  # [m]


class Pursuit:
    """Replacing a goal by a better one is no failure of it."""

    def __init__(self, parts: HeatParts) -> None:
        self._parts = parts
        self.goal: HeatGoal | None = None
        self.without = 0  # plans in a row without a goal
        self._since = 0.0  # [s] of the goal
        self._looks_until: float | None = None  # [s]
        self._finished: list[tuple[float, HeatGoal]] = []  # [s] of those since the newest plan
        self._forgiven = False

    def begin(self, time: float, keep: bool) -> None:
        """From a time [s] on; keep: go on with the goal at hand."""
        self.without = 0
        self._looks_until = None
        goal, self.goal = self.goal, None
        if keep and goal is not None:
            self._drive_to(time, goal)

    def update(self, tick: HeatTick) -> None:
        """One tick."""
        if tick.plan_is_new and tick.plan is not None and tick.plan.placed:
            self._revise(tick, tick.plan)
        goal, trip = self.goal, self._parts.trip
        if goal is not None and self._is_there(tick.pose, goal):
            self._look(tick, goal)
        elif goal is not None and trip.status is TripStatus.FAILED:
            self._parts.notices.append(f"goal given up: {trip.reason}")
            self._parts.goals.failed(tick.time, goal)
            self._end(tick.time)
        if self.goal is None:
            self._choose(tick)

    @property
    def looks(self) -> bool:
        """Whether it stands at its goal and observes."""
        return self._looks_until is not None

    def _revise(self, tick: HeatTick, plan: HeatPlan) -> None:
        """A new plan: what finished goals have left, and what the one at hand still shows."""
        stamp = plan.stamp * 1e-9
        for time, done in self._finished:
            if time <= stamp and done.kind is GoalKind.VIEW:
                left = _left(done.faces, plan.open_faces)
                given_up = self._parts.goals.viewed_in_vain(left)
                self._parts.sensing.coverage.give_up(given_up)
                self._forget_suspects(given_up, plan)
        self._finished = [(time, goal) for time, goal in self._finished if time > stamp]
        goal = self.goal
        if goal is None:
            self._count(plan)
        elif not self.looks and stamp > self._since:
            worth = self._worth_now(goal, plan)
            best = plan.goals[0].worth if plan.goals else 0.0
            if worth == 0.0 or best > BETTER * worth:
                self._end(tick.time)

    def _forget_suspects(self, given_up: Points, plan: HeatPlan) -> None:
        """What was warm there once was none."""
        for x, y in plan.suspects.tolist():
            if (np.hypot(*(given_up - (x, y)).T) < SUSPECT).any():
                self._parts.sensing.forget_near(x, y, SUSPECT)

    def _worth_now(self, goal: HeatGoal, plan: HeatPlan) -> float:
        """[1/s] Of the goal at hand; 0 when what there was to see has been seen on the way."""
        if goal.kind is GoalKind.GROUND:
            return math.inf
        seconds = plan.goal_seconds
        if goal.kind is GoalKind.VIEW:
            left = len(_left(goal.faces, plan.open_faces))
            return worth_of(left, seconds) if left >= max(1.0, LEFT * len(goal.faces)) else 0.0
        away = np.hypot(*(plan.frontiers - (goal.x, goal.y)).T)
        return worth_of(0, seconds) if (away < SAME).any() else 0.0

    def _count(self, plan: HeatPlan) -> None:
        """Plans without a goal; before it is all over, what has failed is tried once more."""
        if plan.goals:
            self.without = 0
        elif plan.waiting and not self._forgiven:
            self._forgiven = True
            for goal in plan.waiting:
                self._parts.goals.forgive(goal)
        else:
            self.without += 1

    def _choose(self, tick: HeatTick) -> None:
        """The best goal of the plan in force that has not been done with since it was made."""
        plan = tick.plan
        if plan is None or not plan.placed or plan.stamp * 1e-9 < self._parts.plan_since:
            return
        done = [goal for time, goal in self._finished if time > plan.stamp * 1e-9]
        for goal in plan.goals:
            if not any(_same(goal, other) for other in done):
                self._drive_to(tick.time, goal)
                return

    def _drive_to(self, time: float, goal: HeatGoal) -> None:
        self.goal, self._since, self._looks_until = goal, time, None
        self._parts.trip.start(goal.pose, TOLERANCE, goal.seconds)

    def _is_there(self, pose: Pose, goal: HeatGoal) -> bool:
        """The lidar sees to all sides: to look beyond a frontier the robot need not turn."""
        if goal.kind is GoalKind.FRONTIER and distance_between(pose, goal.pose) < TOLERANCE:
            return True
        return self._parts.trip.status is TripStatus.REACHED

    def _look(self, tick: HeatTick, goal: HeatGoal) -> None:
        """At the goal: a view waits for the frames that examine its faces."""
        if self._looks_until is None:
            frames = LOOK_FRAMES * self._parts.sensing.period
            seconds = LOOK + frames if goal.kind is GoalKind.VIEW else 0.0
            self._looks_until = tick.time + seconds
        coverage, pose = self._parts.sensing.coverage, tick.pose
        seen = coverage.examined_from(pose.x, pose.y, goal.faces) >= SEEN
        warm = self._parts.sensing.is_warm
        enough = goal.kind is GoalKind.VIEW and seen and not warm
        if tick.time >= self._looks_until + (WARM_LOOK if warm else 0.0) or enough:
            self._parts.goals.reached(goal)
            self._end(tick.time)

    def _end(self, time: float) -> None:
        """The goal at hand is done with."""
        assert self.goal is not None
        self._finished.append((time, self.goal))
        self.goal, self._looks_until = None, None


def _same(a: HeatGoal, b: HeatGoal) -> bool:
    places = math.dist((a.pose.x, a.pose.y), (b.pose.x, b.pose.y))
    return a.kind is b.kind and places < SAME and math.dist((a.x, a.y), (b.x, b.y)) < SAME


def _left(faces: Points, open_faces: Points) -> Points:
    """Of some faces (n, 2) [m] those that are open still."""
    if len(faces) == 0 or len(open_faces) == 0:
        return faces[:0]
    away, _ = KDTree(open_faces).query(faces)
    return faces[away < SAME_FACE]
