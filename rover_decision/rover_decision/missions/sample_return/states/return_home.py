"""RETURN_HOME: follows a path home."""

from __future__ import annotations

import math

from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.drivers import Drivers
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.states.moving import Moving
from rover_decision.missions.sample_return.tick import TickContext
from rover_decision.trouble import MOTION, Limits
from rover_decision.types import Action


class ReturnHome(Moving):
    def __init__(
        self,
        limits: Limits,
        drivers: Drivers,
        parts: Parts,
        home_radius: float,
    ) -> None:
        """home_radius: [m] that counts as there."""
        super().__init__(limits, MOTION)
        self._paths = parts.home_paths
        self._drivers = drivers
        self._parts = parts
        self._home_radius = home_radius

    def enter(self, tick: TickContext, before: State) -> None:
        self._paths.begin(tick.time)
        self.update(tick)

    def update(self, tick: TickContext) -> None:
        self._paths.update(tick.time, tick.pose, self._parts.home, tick.plan)

    def _own_event(self, tick: TickContext) -> Event | None:
        distance = math.dist(self._parts.home, (tick.pose.x, tick.pose.y))
        return Event.arrived if distance < self._home_radius else None

    def act(self, tick: TickContext) -> Action:
        return self._drivers.homeward.drive(tick, self._paths.method, self._parts.home)
