"""PAUSED, FAILED and DONE: stand."""

from __future__ import annotations

from rover_heat.mission.chart import Event, State
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.tick import HeatAction, HeatBehavior, HeatTick


class Standing(HeatBehavior):
    def __init__(self, parts: HeatParts, reason: str) -> None:
        self._parts = parts
        self._reason = reason

    def enter(self, tick: HeatTick, before: State) -> None:
        self._parts.trip.interrupt()

    def event(self, tick: HeatTick) -> Event | None:
        return None

    def act(self, tick: HeatTick) -> HeatAction:
        return HeatAction(self._reason)
