"""STOP: no free ground ahead. Brakes, then turns in place to where it goes on."""

from __future__ import annotations

from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.states.exploring import Exploring
from rover_decision.missions.sample_return.tick import TickContext
from rover_decision.types import Action

STOP_SECONDS = 8.0  # [s] of searching for free ground, after which the rover counts as stuck
ROLLING = 0.2  # [m/s] forward: brakes first


class Stop(Exploring):
    """Brakes, then turns."""

    _side = 1  # of the turn, +1 left

    def enter(self, tick: TickContext, before: State) -> None:
        self._side = tick.local.wider_side()
        self._parts.blocked.stopped(tick.time, tick.pose)

    def _own_trouble(self, tick: TickContext) -> Event | None:
        return Event.stopped_moving if tick.since > STOP_SECONDS else None

    def _way_event(self, tick: TickContext) -> Event | None:
        return Event.cleared if self._drivers.explorer.is_clear(tick) else None

    def act(self, tick: TickContext) -> Action:
        if tick.speed > ROLLING:
            return self._parts.actuation.stop(), "no free ground ahead: stops"
        return self._drivers.explorer.leave_stop(tick, self._side)
