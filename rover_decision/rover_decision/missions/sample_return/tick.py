"""One frame as the states see it."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.geometry import Pose
from rover_decision.behavior import Behavior
from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.samples import SeenRock
from rover_decision.trouble import Health
from rover_decision.types import Action, Frame
from rover_navigation.local_clearance import LocalClearance
from rover_navigation.types import Plan


@dataclass(frozen=True)
class TickContext:
    """A frame, and how the mission stands at it."""

    frame: Frame
    plan: Plan | None  # in force
    local: LocalClearance
    health: Health
    rock: SeenRock | None  # the nearest one worth going for
    time_left: float  # [s] within which to be home
    since: float  # [s] in this state
    explored: float  # 0..1, as the newest plan estimates it
    heading_home: bool  # also when that is interrupted
    return_requested: bool  # to head home when what goes on has come to its end

    @property
    def time(self) -> float:
        """[s]"""
        return self.frame.time

    @property
    def pose(self) -> Pose:
        return self.frame.pose

    @property
    def speed(self) -> float:
        """[m/s] forward positive"""
        return self.frame.speed


class StateBehavior(Behavior[TickContext, State, Event, Action]):
    """What the rover does in one state."""
