"""IDLE, PAUSED and DONE: stand with the brake on."""

from __future__ import annotations

from rover_common.types import SAFE_COMMAND
from rover_decision.missions.sample_return.chart import Event
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.types import Action


class Standing(StateBehavior):
    def __init__(self, reason: str, event: Event | None = None) -> None:
        """event: what happens at the first frame in this state."""
        self._reason = reason
        self._event = event

    def event(self, tick: TickContext) -> Event | None:
        return self._event

    def act(self, tick: TickContext) -> Action:
        return SAFE_COMMAND, self._reason
