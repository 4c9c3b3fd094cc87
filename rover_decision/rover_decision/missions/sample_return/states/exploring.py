"""What the exploring states have in common: rocks come first, and at some time it is done."""

from __future__ import annotations

from rover_decision.missions.sample_return.chart import Event
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.drivers import Drivers
from rover_decision.missions.sample_return.explorers import SHARP
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.states.moving import Moving
from rover_decision.missions.sample_return.tick import TickContext
from rover_decision.trouble import MOTION, PLANNING, Limits


class Exploring(Moving):
    """A state of exploration: FORWARD, STOP or CIRCLE."""

    def __init__(
        self, limits: Limits, drivers: Drivers, parts: Parts, config: DecisionConfig
    ) -> None:
        super().__init__(limits, MOTION | PLANNING)
        self._drivers = drivers
        self._parts = parts
        self._config = config

    def _sample_event(self, tick: TickContext) -> Event | None:
        reached = super()._sample_event(tick)
        if reached is not None:
            return reached
        near = tick.rock is not None and tick.rock.distance < self._config.rock_range
        return Event.rock_seen if near and not tick.return_requested else None

    def _own_event(self, tick: TickContext) -> Event | None:
        if self._parts.completion.reached(tick):
            return Event.finished
        return self._way_event(tick)

    def _way_event(self, tick: TickContext) -> Event | None:
        """What the ground ahead says."""
        return Event.blocked if self._is_blocked(tick) else None

    def _is_blocked(self, tick: TickContext) -> bool:
        """Whether there is too little free ground ahead; none is needed to turn in place."""
        wanted = self._drivers.explorer.wanted_bearing(tick)
        if abs(wanted) > SHARP or self._drivers.explorer.turns_in_place(tick):
            return False
        braking = self._parts.actuation.braking_distance(tick.speed)
        return tick.local.clearance(wanted / 2) < self._config.stop_clearance + braking
