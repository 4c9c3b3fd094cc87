"""FORWARD: explores."""

from __future__ import annotations

from rover_decision.missions.sample_return.chart import Event
from rover_decision.missions.sample_return.states.exploring import Exploring
from rover_decision.missions.sample_return.tick import TickContext
from rover_decision.types import Action

PLANS_UNPLACED = 20  # in a row: turning in place brings neither ground to plan on nor an exit


class Forward(Exploring):
    """Explores."""

    def _own_trouble(self, tick: TickContext) -> Event | None:
        if self._parts.goals.unplaced >= PLANS_UNPLACED:
            return Event.stopped_moving
        return Event.circling if self._parts.circle.circling(tick.time) else None

    def act(self, tick: TickContext) -> Action:
        return self._drivers.explorer.drive(tick)
