"""STUCK: backs up, turns, pushes on: the next step of the recovery sequence."""

from __future__ import annotations

from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.home_paths import HomePaths
from rover_decision.missions.sample_return.states.forward import PLANS_UNPLACED
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.types import Action
from rover_navigation.blocked_places import BlockedPlaces
from rover_navigation.goal_history import GoalHistory
from rover_navigation.recovery import RecoverySequence


class Stuck(StateBehavior):
    def __init__(
        self,
        sequence: RecoverySequence,
        blocked: BlockedPlaces,
        goals: GoalHistory,
        home_paths: HomePaths,
    ) -> None:
        self._sequence = sequence
        self._blocked = blocked
        self._goals = goals
        self._home_paths = home_paths

    def enter(self, tick: TickContext, before: State) -> None:
        self.recoveries += 1
        if before is State.RETURN_HOME:
            self._home_paths.got_stuck()
        self._sequence.advance(tick.pose, tick.local.wider_side())
        if self._goals.unplaced >= PLANS_UNPLACED:
            self._blocked.unblock()  # perhaps that is what shuts it in
        else:
            self._blocked.stuck(tick.time, tick.pose)
        self._goals.await_plans()

    def event(self, tick: TickContext) -> Event | None:
        if self._sequence.exhausted and not tick.heading_home:
            return Event.gave_up
        return Event.recovered if tick.since > self._sequence.step.seconds else None

    def act(self, tick: TickContext) -> Action:
        command, what = self._sequence.command(tick.speed, tick.since)
        return command, f"stuck: {what}"
