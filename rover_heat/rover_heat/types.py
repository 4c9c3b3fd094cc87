"""What the heat mission takes and gives."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.sensor_types import Imu, LaserScan, ThermalFrame, Twist
from rover_common.types import FIRST_RUN, GridMap, Run
from rover_heat.ramp.hazards import NO_HAZARDS, Hazards
from rover_navigation.types import NO_POINTS

Points = NDArray[np.float64]


class PoseSource(Protocol):
    """Where the robot was; behind it stands a buffer of transforms."""

    def pose_at(self, stamp: int) -> Pose | None:
        """Of base_footprint in the map at a stamp [ns]; None where it is not known."""


@dataclass(frozen=True)
class HeatFrame:
    """All that is known at one tick of the control rate; what came since the tick before."""

    stamp: int  # [ns] of the clock
    poses: PoseSource
    pose: Pose | None = None  # of base_footprint in the map, the newest; None before there is one
    pose_stamp: int = 0  # [ns]
    grid: GridMap | None = None  # the newest
    scans: tuple[LaserScan, ...] = ()
    imus: tuple[Imu, ...] = ()
    thermal: tuple[ThermalFrame, ...] = ()
    twist: Twist = Twist()  # noqa: RUF009  # by the wheels, the newest
    launches_done: int = 0  # reports of the launcher
    run: Run = FIRST_RUN
    needs_plan: bool = False

    @property
    def time(self) -> float:
        """[s]"""
        return self.stamp * 1e-9


@dataclass(frozen=True)
class HeatProgress:
    """How far the mission has come, for people."""

    elapsed: float = 0.0  # [s]
    explored: float = 0.0  # 0..1 of the reachable faces of walls
    sources_known: int = 0
    sources_delivered: int = 0
    payloads: int = 0  # sequences left on board
    interrupts: int = 0  # stops because of tilt
    ramp_known: bool = False
    ramp_done: bool = False
    distance: float = 0.0  # [m] driven


@dataclass(frozen=True)
class HeatSource:
    """One source, as far as is known."""

    id: int  # stays with the source for the whole run
    x: float  # [m] map frame, on the wall
    y: float  # [m]
    covariance: tuple[float, float, float, float]  # [m^2] xx, xy, yx, yy
    normal: float  # [rad] of the wall on the warm side
    observations: int
    peak: float  # [K]
    delivered: bool = False


@dataclass(frozen=True)
class HeatDecision:
    """What to do until the next tick, and why."""

    state: IntEnum
    reason: str
    twist: Twist | None = None  # None: the navigator drives
    launch: bool = False  # signal the launcher, once
    hazards: Hazards = NO_HAZARDS
    progress: HeatProgress = field(default_factory=HeatProgress)
    notices: tuple[str, ...] = ()  # to be logged, once each
    new_run: bool = False  # asks for the next run


@dataclass(frozen=True)
class HeatOverlay:
    """What the mission knows about places, for markers and pictures; all in the map frame."""

    sources: tuple[HeatSource, ...] = ()
    hazards: Hazards = NO_HAZARDS
    frontiers: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m]
    faces: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] examined
    open_faces: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] not yet
    visited: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m] frontiers
    trail: Points = field(default_factory=lambda: NO_POINTS)  # (n, 2) [m]
    goal: Pose | None = None
