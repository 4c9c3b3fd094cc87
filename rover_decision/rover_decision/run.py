"""One request to run the mission: what it asks of the mission, and how it ends."""

from __future__ import annotations

import math
from enum import IntEnum

from rover_decision.mission import Mission
from rover_decision.states import State


class Outcome(IntEnum):
    """How a run ended; the values are those of rover_interfaces/RunMission's result."""

    HOME = 1
    CANCELED = 2
    RESTARTED = 3


REASONS = {
    Outcome.HOME: "the mission is over, the rover is home",
    Outcome.CANCELED: "canceled, the rover is home",
    Outcome.RESTARTED: "a new mission has begun",
}


def refusal(time_limit: float, current: Run | None) -> str:
    """Why a run cannot be taken on beside the current one; empty when it can. time_limit: [s]."""
    if not (math.isfinite(time_limit) and time_limit >= 0):
        return f"time_limit must be a number of seconds, 0 or more, not {time_limit}"
    if current is None:
        return ""
    if current.canceled:
        return "the goal before is canceled, the rover is still on its way home"
    return "the mission already runs for another goal: cancel that one first"


class Run:
    """Follows a mission from the request to its end."""

    def __init__(self, mission: Mission, time_limit: float = 0.0) -> None:
        """Follow the mission that runs; start one where none does.

        time_limit: [s] of mission time, from its first frame on, within which to be home; 0 for the
        parameter's.
        """
        if mission.state in (State.IDLE, State.DONE):
            mission.reset()
        if time_limit > 0:
            mission.limit_time(time_limit)
        self._mission, self._number = mission, mission.number
        self._canceled = False

    @property
    def canceled(self) -> bool:
        return self._canceled

    def cancel(self) -> None:
        """Come home; the run ends there."""
        self._canceled = True
        self._mission.return_home()

    def outcome(self) -> Outcome | None:
        """How the run has ended; None as long as it goes on."""
        if self._mission.number != self._number:
            return Outcome.RESTARTED
        if self._mission.state is State.DONE:
            return Outcome.CANCELED if self._canceled else Outcome.HOME
        if self._mission.state is State.IDLE and self._canceled:
            return Outcome.CANCELED  # it never left, and no frame may ever come
        return None
