"""One goal to run the mission: what it asks of the mission, and how it ends."""

from __future__ import annotations

import math
from enum import IntEnum

from rover_decision.core import DecisionCore
from rover_decision.types import Request


class Outcome(IntEnum):
    """How a goal ended; the values are those of the actions' results."""

    HOME = 1  # over, as the mission has it
    CANCELED = 2
    RESTARTED = 3
    FAILED = 4


REASONS = {
    Outcome.HOME: "the mission is over, the rover is home",
    Outcome.CANCELED: "canceled, the rover is home",
    Outcome.RESTARTED: "a new run has begun",
    Outcome.FAILED: "the mission cannot go on",
}


def refusal(time_limit: float, current: MissionGoal | None) -> str:
    """Why a goal cannot be accepted beside the current one; empty when it can. time_limit: [s]."""
    if not (math.isfinite(time_limit) and time_limit >= 0):
        return f"time_limit must be a number of seconds, 0 or more, not {time_limit}"
    if current is None:
        return ""
    if current.canceled:
        return "the goal before is canceled, the rover still heads home"
    return "the mission already runs for another goal: cancel that one first"


class MissionGoal:
    """Follows a mission from the goal's acceptance to its end."""

    def __init__(self, core: DecisionCore, time_limit: float = 0.0) -> None:
        """Follow the mission that runs; start one where none does.

        time_limit: [s] of mission time, from its first frame on, within which to be home; 0 for the
        parameter's.
        """
        core.request(Request.START)
        if time_limit > 0 or core.mission.idle:
            core.mission.limit_time(time_limit)
        self._core, self._number = core, core.mission_number
        self._canceled = False

    @property
    def canceled(self) -> bool:
        return self._canceled

    def cancel(self) -> None:
        """Come home; the goal ends there."""
        self._canceled = True
        self._core.request(Request.RETURN_HOME)

    def outcome(self) -> Outcome | None:
        """How the goal has ended; None as long as it goes on."""
        if self._core.mission_number != self._number:
            return Outcome.RESTARTED
        if self._core.mission.over:
            return Outcome.CANCELED if self._canceled else Outcome.HOME
        if self._core.mission.idle and self._canceled:
            return Outcome.CANCELED  # it never left, and no frame may ever come
        return Outcome.FAILED if self._core.mission.failed else None
