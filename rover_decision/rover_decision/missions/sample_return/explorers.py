"""How to explore along plans, and how to drive by sight where there is none."""

from __future__ import annotations

import math

import numpy as np

from rover_common.geometry import bearing_to
from rover_common.types import Command
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.tick import TickContext
from rover_decision.types import Action
from rover_navigation.actuation import Actuation, approach_speed
from rover_navigation.local_clearance import LocalClearance
from rover_navigation.path_tracking import PathTracker
from rover_navigation.scale import Scale
from rover_navigation.types import GoalKind

PATH_AHEAD = math.radians(12.0)  # a path this near to straight ahead can be driven into
SHARP = math.radians(40.0)  # a path further aside is turned to in place, with no free ground ahead
CLEARANCE_TO_GO = 1.2  # of the clearance below which it stops: not to stop again at once
SCAN_TURN = math.radians(60.0)  # out of sight, so that the turn goes on
SPEED_MIN = 0.3  # [m/s] of driving by sight
ALIGN_SECONDS, SCAN_SECONDS = 0.5, 1.0  # [s] in STOP, at least


class SightDriver:
    """Drives towards bearings, at the speed that the free ground allows."""

    def __init__(self, actuation: Actuation, scale: Scale, config: DecisionConfig) -> None:
        self.actuation = actuation
        self._stop_margin = scale.stop_margin
        self._top_speed = config.top_speed
        self._go_clearance = config.go_clearance

    def towards(self, tick: TickContext, bearing: float) -> Command:
        """In a curve, the corridor to its side counts as well."""
        ahead = min(tick.local.clearance(bearing), tick.local.clearance(bearing / 2))
        speed = min(self._top_speed, approach_speed(ahead - self._stop_margin))
        return self.actuation.drive(tick.speed, max(SPEED_MIN, speed), bearing)

    def leave_circle(self, tick: TickContext) -> Action:
        """Towards the free bearing nearest to the mean of the navigable ones."""
        nav = tick.frame.nav
        if len(nav.bearings) == 0:
            return self.actuation.stop(), "sees no ground"
        mean = float(nav.bearings.astype(np.float64).mean())
        bearing = tick.local.best_bearing(mean, self._go_clearance)
        return self.towards(tick, bearing), "leaves the circle"

    def turn_to_open(self, tick: TickContext, side: int) -> Action:
        """Turn to the nearest free corridor by sight, to the side where none is seen."""
        free = tick.local.open_bearing(self._go_clearance)
        bearing = side * SCAN_TURN if free is None else free
        return self.actuation.turn_in_place(tick.speed, bearing), "turns to find free ground"

    def is_open(self, tick: TickContext) -> bool:
        """Whether the ground ahead is free by sight."""
        free = tick.local.open_bearing(self._go_clearance)
        return free is not None and abs(free) < PATH_AHEAD


class PlanExplorer:
    """Drives along the plans."""

    def __init__(self, tracker: PathTracker, sight: SightDriver, config: DecisionConfig) -> None:
        self._tracker = tracker
        self._sight = sight
        self._actuation = sight.actuation
        self._clearance_to_go = CLEARANCE_TO_GO * config.stop_clearance

    def wanted_bearing(self, tick: TickContext) -> float:
        """Where it leads [rad]."""
        plan = tick.plan
        if plan is None or len(plan.path) == 0:
            return 0.0
        if plan.goal is not None and self.turns_in_place(tick):
            return bearing_to(tick.pose, plan.goal.x, plan.goal.y)
        return self._tracker.bearing(tick.pose, plan.path)

    def turns_in_place(self, tick: TickContext) -> bool:
        """Whether the rover is where its goal is observed from, and turns there in place."""
        plan = tick.plan
        if plan is None or plan.goal is None or plan.goal.kind is GoalKind.TARGET:
            return False
        return len(plan.path) > 0 and self._tracker.at_end(tick.pose, plan.path)

    def drive(self, tick: TickContext) -> Action:
        """Explore on."""
        plan = tick.plan
        if plan is None:
            return self._actuation.stop(), "waits for the first plan"
        if plan.goal is None or len(plan.path) == 0:
            turn = self._actuation.turn_in_place(tick.speed, SCAN_TURN)
            return turn, "turns in search of a goal"
        what = plan.goal.kind.value
        if self.turns_in_place(tick):
            turn = self._actuation.turn_in_place(tick.speed, self.wanted_bearing(tick))
            return turn, f"observes {what}"
        command = self._tracker.command(tick.pose, tick.speed, plan.path, tick.local)
        return command, f"drives to {what}"

    def leave_stop(self, tick: TickContext, side: int) -> Action:
        """Turn to where it goes on, or to a side (+1 left) until ground is free; it stands."""
        if tick.plan is None:
            return self._sight.turn_to_open(tick, side)
        if len(tick.plan.path) == 0:
            turn = self._actuation.turn_in_place(tick.speed, SCAN_TURN)
            return turn, "turns to find a path"
        bearing = self.wanted_bearing(tick)
        if abs(bearing) < PATH_AHEAD and not self._has_clearance(tick.local, bearing):
            return self._actuation.reverse(), "too near for the new path: backs up"
        return self._actuation.turn_in_place(tick.speed, bearing), "turns to the new path"

    def is_clear(self, tick: TickContext) -> bool:
        """Whether it can drive on from a stop."""
        plan = tick.plan
        if plan is None:
            return self._sight.is_open(tick)
        if plan.goal is None:
            return tick.since > SCAN_SECONDS  # it turns in search of a goal
        wanted = self.wanted_bearing(tick)
        aligned = tick.since > ALIGN_SECONDS and abs(wanted) < PATH_AHEAD
        return aligned and self._has_clearance(tick.local, wanted)

    def _has_clearance(self, local: LocalClearance, bearing: float) -> bool:
        """Whether there is enough free ground to set out in this direction [rad]."""
        return local.clearance(bearing) > self._clearance_to_go
