"""HOLD: an input is missing or too old. Stands with the brake on until all are fresh again."""

from __future__ import annotations

from rover_common.types import SAFE_COMMAND
from rover_decision.missions.sample_return.chart import Event
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.trouble import INPUTS, PLANNING, Limits, first_trouble
from rover_decision.types import Action

ROLLING = 0.2  # [m/s] it stands below
DEADLINE = 10.0  # [s] after which it goes home by sight, without plans


class Hold(StateBehavior):
    def __init__(self, limits: Limits) -> None:
        self._limits = limits

    def event(self, tick: TickContext) -> Event | None:
        watched = INPUTS - PLANNING if tick.heading_home else INPUTS
        fresh = first_trouble(tick.health, self._limits, watched) is None
        if fresh and abs(tick.speed) < ROLLING:
            return Event.inputs_restored
        return Event.gave_up if tick.since > DEADLINE else None

    def act(self, tick: TickContext) -> Action:
        trouble = first_trouble(tick.health, self._limits, INPUTS)
        return SAFE_COMMAND, "holds" if trouble is None else f"holds: {trouble.value}"
