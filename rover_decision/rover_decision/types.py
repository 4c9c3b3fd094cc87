"""What the decision core takes and gives."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum, IntEnum

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.types import Command, FreeScan, PolarArray, RockTrack, Run, VehicleState
from rover_navigation.types import NO_POINTS, BlockedPlace, Path, Plan

Action = tuple[Command, str]  # what to do, and why


class Request(Enum):
    """What a person or another node may ask a mission for."""

    START = "start"
    PAUSE = "pause"
    RESUME = "resume"
    RETURN_HOME = "return_home"
    RESET = "reset"


@dataclass(frozen=True)
class Frame:
    """All that is known at one camera frame."""

    vehicle: VehicleState
    nav: PolarArray  # navigable ground cells
    scan: FreeScan
    rocks: tuple[RockTrack, ...] = ()  # all that are confirmed
    map_stamp: int = -1  # [ns] of the newest maps that are due, this frame's or an older one's
    rock: PolarArray = field(default_factory=PolarArray.empty)  # rock cells in view

    @property
    def stamp(self) -> int:
        """[ns]"""
        return self.vehicle.stamp

    @property
    def time(self) -> float:
        """[s]"""
        return self.vehicle.stamp * 1e-9

    @property
    def pose(self) -> Pose:
        return self.vehicle.pose

    @property
    def speed(self) -> float:
        """[m/s] forward positive"""
        return self.vehicle.speed

    @property
    def run(self) -> Run:
        return self.vehicle.run

    @property
    def needs_plan(self) -> bool:
        """Whether a plan is to be made at it: its map is due."""
        return self.map_stamp == self.stamp


@dataclass(frozen=True)
class Progress:
    """How far the mission has come, for people."""

    elapsed: float = 0.0  # [s]
    explored: float = 0.0  # 0..1
    samples_total: int = 0
    samples_collected: int = 0
    rocks_known: int = 0
    rocks_given_up: int = 0
    home_distance: float = 0.0  # [m]
    distance: float = 0.0  # [m] driven
    recoveries: int = 0  # manoeuvres begun because of being stuck or tilted


@dataclass(frozen=True)
class Decision:
    """What to do about one frame, and why."""

    command: Command
    state: IntEnum  # of the mission
    reason: str
    progress: Progress = field(default_factory=Progress)


@dataclass(frozen=True)
class Overlay:
    """What a mission knows about places, for markers and pictures."""

    breadcrumbs: NDArray[np.float64]  # (n, 2) [m] map frame
    blocked: tuple[BlockedPlace, ...] = ()
    plan: Plan | None = None
    path: Path | None = None  # the one that is driven now

    @property
    def frontiers(self) -> NDArray[np.float64]:
        """(n, 2) [m]"""
        return NO_POINTS if self.plan is None else self.plan.frontiers
