"""ATTEMPTING_RAMP: climbs the ramp, and releases the last payload on top; seeks it when unknown."""

from __future__ import annotations

from collections.abc import Collection

from rover_decision.trouble import Trouble
from rover_heat.mission.chart import Event, State
from rover_heat.mission.launch import Launch
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.pursuit import Pursuit
from rover_heat.mission.ramp_attempt import Phase, RampAttempt
from rover_heat.mission.ramp_look import RampLook
from rover_heat.mission.states.driving import COMMON, Driving
from rover_heat.mission.states.exploring import PLANS_WITHOUT_GOAL, RESTORED
from rover_heat.mission.tick import HeatAction, HeatTick

ON_WHEELS = frozenset({Trouble.input_gap, Trouble.clock_apart})


class AttemptingRamp(Driving):
    """The interrupt by tilt is armed until the climb itself begins."""

    def __init__(self, parts: HeatParts) -> None:
        super().__init__(parts)
        self._pursuit = Pursuit(parts)
        self._attempt = RampAttempt(parts)
        self._launch: Launch | None = None
        self._look: RampLook | None = None  # once the payload is released

    def enter(self, tick: HeatTick, before: State) -> None:
        self._parts.plan_since = tick.time
        self._pursuit.begin(tick.time, keep=before in RESTORED)
        self._attempt.restart(tick.time)

    def update(self, tick: HeatTick) -> None:
        agenda = self._parts.agenda
        if self._seeks:
            self._pursuit.update(tick)
            agenda.ramp_given_up |= self._pursuit.without >= PLANS_WITHOUT_GOAL
            return
        self._attempt.update(tick)
        agenda.ramp_given_up |= self._attempt.phase is Phase.GIVEN_UP
        if self._attempt.phase is Phase.ON_TOP:
            self._release(tick)

    def _watched(self) -> Collection[Trouble]:
        return ON_WHEELS if self._attempt.on_wheels_alone else COMMON

    def _own_event(self, tick: HeatTick) -> Event | None:
        agenda = self._parts.agenda
        return agenda.next_event() if agenda.ramp_given_up or self._parts.ramps.done else None

    def act(self, tick: HeatTick) -> HeatAction:
        if self._seeks:
            goal = self._pursuit.goal
            doing = "waits for a plan" if goal is None else f"seeks the ramp: {goal.kind.value}"
            return HeatAction(doing, None)
        launch, look = self._launch, self._look
        if look is not None:
            return HeatAction(f"on the ramp: {look.reason}", look.twist)
        if launch is not None:
            return HeatAction(f"on the ramp: {launch.reason}", launch=launch.signalled_now)
        return HeatAction(self._attempt.phase.value, self._attempt.twist)

    @property
    def _seeks(self) -> bool:
        return not self._parts.ramps.ramps

    def _release(self, tick: HeatTick) -> None:
        """On top: the last payload, if one is left, and a look at what is ahead."""
        parts = self._parts
        if self._launch is None:
            self._launch = Launch(parts)
            self._launch.begin(tick.time, None)
        if self._look is not None:
            self._look.update(tick)
            parts.ramps.done = self._look.done
            return
        if parts.agenda.payloads == 0 and not self._launch.signalled:
            self._look, parts.ramps.served = RampLook(parts), True
            return
        self._launch.update(tick, None)
        if self._launch.signalled_now:
            parts.spend_payload(tick.time)
            parts.ramps.served = True
            parts.notices.append("launch: the last payload, on the ramp")
        if self._launch.done or self._launch.missed:
            self._look = RampLook(parts)
