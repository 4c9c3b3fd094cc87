"""HOLD: an input is missing, a clock is off, the navigator is silent. Stands until it is back."""

from __future__ import annotations

from rover_decision.trouble import INPUTS, Trouble, first_trouble
from rover_heat.mission.chart import Event, State
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.states.driving import limits_of
from rover_heat.mission.tick import HeatAction, HeatBehavior, HeatTick

DEADLINE, NAVIGATOR_DEADLINE = 30.0, 20.0  # [s] until it counts as failed
STANDS = 0.02  # [m/s]
WATCHED = INPUTS - {Trouble.map_stale} | {Trouble.clock_apart, Trouble.navigator_lost}


class Hold(HeatBehavior):
    def __init__(self, parts: HeatParts) -> None:
        self._parts = parts
        self._limits = limits_of(parts.config)

    def enter(self, tick: HeatTick, before: State) -> None:
        self._parts.trip.interrupt()

    def event(self, tick: HeatTick) -> Event | None:
        trouble = self._trouble(tick)
        if trouble is None and abs(tick.frame.twist.linear) < STANDS:
            return Event.inputs_restored
        lost = tick.health.navigator_silent > self._limits.navigator_silent
        deadline = NAVIGATOR_DEADLINE if lost else DEADLINE
        return Event.gave_up if tick.since > deadline else None

    def act(self, tick: HeatTick) -> HeatAction:
        trouble, missing = self._trouble(tick), self._parts.inputs.missing
        if trouble is Trouble.input_gap and missing:
            return HeatAction(f"holds: no {', no '.join(missing)}")
        if trouble is Trouble.clock_apart:
            apart = self._parts.inputs.apart
            return HeatAction(f"holds: clock: stamps are {apart:.1f} s from it")
        return HeatAction("holds" if trouble is None else f"holds: {trouble.value}")

    def _trouble(self, tick: HeatTick) -> Trouble | None:
        return first_trouble(tick.health, self._limits, WATCHED)
