"""RETURNING: down from the ramp, and back to the start."""

from __future__ import annotations

from collections.abc import Collection

from rover_common.geometry import Pose, distance_between
from rover_decision.trouble import Trouble
from rover_heat.mission.back_track import towards
from rover_heat.mission.chart import Event, State
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.ramp_attempt import BEFORE_FOOT, REACHED, RETREAT_SECONDS
from rover_heat.mission.states.attempting_ramp import ON_WHEELS
from rover_heat.mission.states.driving import COMMON, Driving
from rover_heat.mission.tick import HeatAction, HeatTick
from rover_heat.mission.trip import TripStatus

TOLERANCE = 0.15  # [m]
TRIES = 3


class Returning(Driving):
    def __init__(self, parts: HeatParts) -> None:
        super().__init__(parts)
        self._descent: Pose | None = None  # to back down to
        self._tries = 0

    def enter(self, tick: HeatTick, before: State) -> None:
        if before is State.ATTEMPTING_RAMP and self._parts.ramps.done:
            self._descent = self._foot(tick.pose)
        if self._descent is None:
            self._drive()

    def update(self, tick: HeatTick) -> None:
        if self._descent is not None:
            there = distance_between(self._descent, tick.pose) < REACHED
            if there or tick.since > RETREAT_SECONDS:
                self._descent = None
                self._drive()
        elif self._parts.trip.status is TripStatus.FAILED:
            self._tries += 1
            self._parts.notices.append(f"way back: {self._parts.trip.reason}")
            if self._tries < TRIES:
                self._drive()

    def _watched(self) -> Collection[Trouble]:
        return COMMON if self._descent is None else ON_WHEELS

    def _own_event(self, tick: HeatTick) -> Event | None:
        there = self._descent is None and self._parts.trip.status is TripStatus.REACHED
        if there or self._tries >= TRIES:
            return Event.finish
        return None

    def act(self, tick: HeatTick) -> HeatAction:
        if self._descent is not None:
            return HeatAction("backs down from the ramp", towards(self._descent, tick.pose))
        return HeatAction("drives back to the start", None)

    def _drive(self) -> None:
        parts = self._parts
        start = parts.start or Pose(0.0, 0.0, 0.0)
        parts.trip.start(start, TOLERANCE, parts.time_limit)

    def _foot(self, pose: Pose) -> Pose | None:
        ramps = self._parts.ramps.ramps
        nearest = min(ramps, key=lambda r: distance_between(r.before_foot(0.0), pose), default=None)
        return None if nearest is None else nearest.before_foot(BEFORE_FOOT)
