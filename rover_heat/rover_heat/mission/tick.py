"""One tick as the states see it."""

from __future__ import annotations

from dataclasses import dataclass, field

from rover_common.geometry import Pose
from rover_common.sensor_types import Twist
from rover_decision.behavior import Behavior
from rover_decision.trouble import Health
from rover_heat.mission.chart import Event, State
from rover_heat.mission.ownership import STAND
from rover_heat.planning.types import HeatPlan
from rover_heat.types import HeatFrame


@dataclass(frozen=True)
class HeatTick:
    """A frame, and how the mission stands at it."""

    frame: HeatFrame
    pose: Pose  # the newest; the map's origin before there is one
    plan: HeatPlan | None  # in force
    plan_is_new: bool  # it was not at the tick before
    health: Health
    since: float  # [s] in this state

    @property
    def time(self) -> float:
        """[s]"""
        return self.frame.time


@dataclass(frozen=True)
class HeatAction:
    """What a state wants at a tick, and why."""

    reason: str
    twist: Twist | None = field(default=STAND)  # None: the navigator drives
    launch: bool = False


class HeatBehavior(Behavior[HeatTick, State, Event, HeatAction]):
    """What the robot does in one state."""
