"""CIRCLE: has turned to one side for too long. Follows the mean of the navigable bearings."""

from __future__ import annotations

from rover_decision.missions.sample_return.chart import Event
from rover_decision.missions.sample_return.states.exploring import Exploring
from rover_decision.missions.sample_return.tick import TickContext
from rover_decision.types import Action

CIRCLE_SECONDS = 10.0  # [s]


class Circle(Exploring):
    """Leaves the circle."""

    def _way_event(self, tick: TickContext) -> Event | None:
        if tick.since > CIRCLE_SECONDS:
            return Event.recovered
        return super()._way_event(tick)

    def act(self, tick: TickContext) -> Action:
        return self._drivers.sight.leave_circle(tick)
