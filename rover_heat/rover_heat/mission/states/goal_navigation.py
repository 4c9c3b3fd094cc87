"""GOAL_NAVIGATION: drives to where the next source is served from."""

from __future__ import annotations

import math
from collections.abc import Collection

from rover_common.geometry import Pose, distance_between
from rover_decision.trouble import Trouble
from rover_heat.mission.chart import Event, State
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.states.driving import PLANNED, Driving
from rover_heat.mission.tick import HeatAction, HeatTick
from rover_heat.mission.trip import TripStatus

CORRECTIONS = 2  # times that it drives again to where the source is seen to be from near
TOLERANCE_SHARE = (
    0.9  # of the stand-off's tolerance, for the navigator; a robot does not drive sideways
)


class GoalNavigation(Driving):
    """`target` is the number of the source that it drives to, or stands before."""

    def __init__(self, parts: HeatParts) -> None:
        super().__init__(parts)
        self.target: int | None = None
        self._corrections = 0
        self._there = False

    def enter(self, tick: HeatTick, before: State) -> None:
        self._parts.plan_since = tick.time
        if before is State.LAUNCHING or before is State.EXPLORING:
            self.target = None
        self._parts.trip.cancel()
        self._there = False

    def update(self, tick: HeatTick) -> None:
        parts = self._parts
        if self.target is None or parts.sources.get(self.target) is None:
            self._choose()
        if self.target is None:
            return
        status = parts.trip.status
        if status is TripStatus.REACHED:
            self._arrive(tick)
        elif status is TripStatus.FAILED:
            parts.notices.append(f"source {self.target}: {parts.trip.reason}: another pose")
            parts.sources.failed(self.target)
            self._choose()
        elif status is TripStatus.NONE:
            self._drive()

    def _watched(self) -> Collection[Trouble]:
        return PLANNED

    def _own_event(self, tick: HeatTick) -> Event | None:
        if self._there:
            return Event.at_stand_off
        if self.target is None:
            event = self._parts.agenda.next_event()
            return None if event is Event.deliver else event
        return None

    def act(self, tick: HeatTick) -> HeatAction:
        if self.target is None:
            return HeatAction("chooses a source", None)
        return HeatAction(f"drives to source {self.target}", None)

    def _choose(self) -> None:
        source = self._parts.agenda.next_source()
        self.target = None if source is None else source.id
        self._corrections = 0
        if self.target is not None:
            self._drive()

    def _drive(self) -> None:
        assert self.target is not None
        stand = self._parts.sources.stand_off(self.target)
        if stand is None:
            self._parts.sources.failed(self.target)
            self.target = None
            return
        tolerance = TOLERANCE_SHARE * self._parts.config.stand_off_tolerance
        self._parts.trip.start(stand.pose, tolerance, stand.seconds)

    def _arrive(self, tick: HeatTick) -> None:
        """At the pose: there, unless the source turns out to be somewhat aside."""
        assert self.target is not None
        stand = self._parts.sources.stand_off(self.target)
        if stand is not None and self._is_aside(stand.pose, tick.pose):
            self._corrections += 1
            self._drive()
        else:
            self._there = True

    def _is_aside(self, wanted: Pose, pose: Pose) -> bool:
        away = distance_between(wanted, pose)
        tolerance = self._parts.config.stand_off_tolerance
        return math.isfinite(away) and away > tolerance and self._corrections < CORRECTIONS
