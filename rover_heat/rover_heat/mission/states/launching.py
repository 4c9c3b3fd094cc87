"""LAUNCHING: stands before a source, turns to it, releases the payload when all is still."""

from __future__ import annotations

from collections.abc import Collection

from rover_decision.trouble import Trouble
from rover_heat.mission.chart import Event, State
from rover_heat.mission.launch import Launch
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.states.driving import Driving
from rover_heat.mission.states.goal_navigation import GoalNavigation
from rover_heat.mission.tick import HeatAction, HeatTick
from rover_heat.types import HeatSource

STANDING = frozenset({Trouble.tilted, Trouble.input_gap, Trouble.clock_apart})
INTERRUPTIONS = (State.HOLD, State.PAUSED, State.FAILED, State.TILT_INTERRUPT)


class Launching(Driving):
    def __init__(self, parts: HeatParts, approach: GoalNavigation) -> None:
        super().__init__(parts)
        self._approach = approach
        self._launch = Launch(parts)

    def enter(self, tick: HeatTick, before: State) -> None:
        if before not in INTERRUPTIONS or not self._launch.signalled:
            self._launch = Launch(self._parts)
        self._launch.begin(tick.time, self._source())

    def update(self, tick: HeatTick) -> None:
        if self._is_gone:
            return
        self._launch.update(tick, self._source())
        if self._launch.signalled_now:
            number = self._approach.target
            assert number is not None
            self._parts.sources.mark_delivered(number)
            self._parts.spend_payload(tick.time)
            self._parts.notices.append(f"launch: payload for source {number}")

    def event(self, tick: HeatTick) -> Event | None:
        """A sequence that runs is not interrupted: the robot stands in any case."""
        if self._launch.done:
            return self._parts.agenda.next_event()
        return None if self._launch.signalled else super().event(tick)

    def _watched(self) -> Collection[Trouble]:
        return STANDING

    def _own_event(self, tick: HeatTick) -> Event | None:
        if self._is_gone:
            return self._parts.agenda.next_event()
        return Event.deliver if self._launch.missed else None

    def act(self, tick: HeatTick) -> HeatAction:
        launch = self._launch
        return HeatAction(launch.reason, launch.twist, launch.signalled_now)

    @property
    def _is_gone(self) -> bool:
        """Whether the source proved to be none, before anything was released."""
        return self._source() is None and not self._launch.signalled

    def _source(self) -> HeatSource | None:
        number = self._approach.target
        return None if number is None else self._parts.sources.get(number)
