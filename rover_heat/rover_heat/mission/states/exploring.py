"""EXPLORING: drives to frontiers, and to where walls can be examined for heat."""

from __future__ import annotations

from collections.abc import Collection

from rover_decision.trouble import Trouble
from rover_heat.mission.chart import Event, State
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.pursuit import Pursuit
from rover_heat.mission.states.driving import PLANNED, Driving
from rover_heat.mission.tick import HeatAction, HeatTick

PLANS_WITHOUT_GOAL = 3  # in a row, and nothing is left to see
RESTORED = (State.HOLD, State.PAUSED, State.FAILED)  # after these it goes on with the same goal


class Exploring(Driving):
    def __init__(self, parts: HeatParts) -> None:
        super().__init__(parts)
        self._pursuit = Pursuit(parts)

    def enter(self, tick: HeatTick, before: State) -> None:
        self._parts.plan_since = tick.time
        self._pursuit.begin(tick.time, keep=before in RESTORED)

    def update(self, tick: HeatTick) -> None:
        self._pursuit.update(tick)
        if self._pursuit.without >= PLANS_WITHOUT_GOAL:
            self._parts.agenda.explored = True

    def _watched(self) -> Collection[Trouble]:
        return PLANNED

    def _own_event(self, tick: HeatTick) -> Event | None:
        event = self._parts.agenda.next_event()
        return None if event is Event.explore else event

    def act(self, tick: HeatTick) -> HeatAction:
        goal = self._pursuit.goal
        if goal is None:
            return HeatAction("waits for a plan", None)
        doing = "observes" if self._pursuit.looks else "drives to"
        return HeatAction(f"{doing} {goal.kind.value}", None)
