"""What all states have in common in which the rover moves by itself."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Collection
from dataclasses import replace

from rover_decision.missions.sample_return.chart import Event
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.trouble import Limits, Trouble, first_trouble

SLOW = 1.0  # [m/s] from which it stops within 0.2 m, so that the sample stays in reach


class Moving(StateBehavior):
    """The arm first, then trouble, then a sample in reach, then what concerns the state itself."""

    def __init__(
        self, limits: Limits, watched: Collection[Trouble], tilt_factor: float = 1.0
    ) -> None:
        """tilt_factor: of the limit for the tilt, in this state."""
        self._limits = replace(limits, tilt=tilt_factor * limits.tilt)
        self._watched = watched

    def event(self, tick: TickContext) -> Event | None:
        if tick.frame.vehicle.picking_up:  # late, or started by somebody else
            return Event.rock_reached
        trouble = first_trouble(tick.health, self._limits, self._watched)
        if trouble is not None:
            return Event[trouble.name]
        return self._own_trouble(tick) or self._sample_event(tick) or self._own_event(tick)

    def _own_trouble(self, tick: TickContext) -> Event | None:
        """Trouble of this state alone."""
        return None

    def _sample_event(self, tick: TickContext) -> Event | None:
        vehicle = tick.frame.vehicle
        if vehicle.near_sample and abs(vehicle.speed) < SLOW:
            return Event.rock_reached
        return None

    @abstractmethod
    def _own_event(self, tick: TickContext) -> Event | None:
        """What else may happen in this state."""
