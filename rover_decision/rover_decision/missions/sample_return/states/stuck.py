"""STUCK: backs up, turns, pushes on: the next step of the recovery sequence."""

from __future__ import annotations

from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.states.forward import PLANS_UNPLACED
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.types import Action
from rover_navigation.recovery import RecoverySequence


class Stuck(StateBehavior):
    """Recovers."""

    def __init__(self, sequence: RecoverySequence, parts: Parts) -> None:
        self._sequence = sequence
        self._parts = parts

    def enter(self, tick: TickContext, before: State) -> None:
        self.recoveries += 1
        parts = self._parts
        if before is State.RETURN_HOME:
            parts.home_paths.got_stuck()
        self._sequence.advance(tick.pose, tick.local.wider_side())
        if parts.goals.unplaced >= PLANS_UNPLACED:
            parts.blocked.unblock()  # perhaps that is what shuts it in
        else:
            parts.blocked.stuck(tick.time, tick.pose)
        parts.goals.await_plans()

    def event(self, tick: TickContext) -> Event | None:
        if self._sequence.exhausted and not tick.heading_home:
            return Event.gave_up
        return Event.recovered if tick.since > self._sequence.step.seconds else None

    def act(self, tick: TickContext) -> Action:
        command, what = self._sequence.command(tick.speed, tick.since)
        return command, f"stuck: {what}"
