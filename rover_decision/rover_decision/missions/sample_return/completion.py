"""When the mission has done what it can out there, and what is tried once more before that."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from rover_decision.missions.sample_return.samples import Samples
from rover_decision.missions.sample_return.tick import TickContext
from rover_navigation.blocked_places import BlockedPlaces
from rover_navigation.goal_history import GoalHistory
from rover_navigation.types import GoalKind

PLANS_WITHOUT_GOAL = 12  # in a row, while looking around: nothing is left
HOME_RESERVE = 1.3  # of the time estimated for the home path
HOME_EXTRA = 30.0  # [s]


@dataclass(frozen=True)
class Trigger:
    """A share of the map that completes the mission, beside the samples."""

    share: float = 0.0  # 0..1; 0 for none
    all_of_it: bool = False  # both are wanted; else either will do

    def reached(self, all_collected: bool, explored: float) -> bool:
        """Whether the mission is complete; without a share, by the samples alone."""
        if self.share == 0.0:
            return all_collected
        mapped = explored >= self.share
        return (all_collected and mapped) if self.all_of_it else (all_collected or mapped)


class Completion:
    """Watches the goals, the samples and the time."""

    def __init__(
        self,
        samples: Samples,
        goals: GoalHistory,
        blocked: BlockedPlaces,
        search_limit: float,
        trigger: Trigger,
    ) -> None:
        """search_limit: [s] of searching known ground for samples."""
        self._trigger = trigger
        self._samples = samples
        self._goals = goals
        self._blocked = blocked
        self._search_limit = search_limit
        self._retried = False
        self._searched = 0.0  # [s]

    def memory(self) -> dict[str, Any]:
        """What was tried, for JSON."""
        return {"retried": self._retried, "searched": self._searched}

    def restore(self, memory: dict[str, Any]) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        self._retried, self._searched = bool(memory["retried"]), float(memory["searched"])

    @property
    def searches(self) -> bool:
        """Whether to search for rocks that nobody has seen."""
        return not self._samples.all_collected and self._searched < self._search_limit

    def update(self, tick: TickContext, exploring: bool) -> None:
        """Once per frame. Before it is all over, what was given up is tried once more."""
        goal = None if tick.plan is None else tick.plan.goal
        if goal is not None and goal.kind is GoalKind.SEARCH:
            self._searched += max(0.0, tick.health.gap)
        if exploring and self._explored(tick) and not self._retried:
            self._retried = True
            self._retry(tick.time)

    def reached(self, tick: TickContext) -> bool:
        """Whether to go home now: by the share of the map if there is one, else by the goals."""
        if tick.return_requested or self._time_is_up(tick) or self._explored(tick):
            return True
        return self._trigger.share > 0.0 and self._triggered(tick)

    def classic(self, tick: TickContext) -> bool:
        """The same for a solution without goals: by the samples, and a share if there is one."""
        return tick.return_requested or tick.time_left < 0.0 or self._triggered(tick)

    def _triggered(self, tick: TickContext) -> bool:
        return self._trigger.reached(self._samples.all_collected, tick.explored)

    def _explored(self, tick: TickContext) -> bool:
        return tick.plan is not None and self._goals.missing >= PLANS_WITHOUT_GOAL

    def _time_is_up(self, tick: TickContext) -> bool:
        needed = 0.0
        if tick.plan is not None and math.isfinite(tick.plan.home_seconds):
            needed = HOME_RESERVE * tick.plan.home_seconds + HOME_EXTRA
        return needed > tick.time_left

    def _retry(self, time: float) -> None:
        """Unblock, and take goals for unobserved: all of them while samples are missing."""
        unblocked = self._blocked.unblock()
        done = self._samples.all_collected
        reopened = self._goals.retry(time) if done else self._goals.forget()
        if unblocked or reopened:
            self._goals.await_plans()
