"""What the mission's core takes and gives."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.types import Command, FreeScan, PolarArray, RockTrack, VehicleState
from rover_decision.states import State
from rover_navigation.types import Plan


@dataclass(frozen=True)
class Snapshot:
    """All that is known at one frame."""

    vehicle: VehicleState
    nav: PolarArray  # navigable ground cells
    scan: FreeScan
    rocks: tuple[RockTrack, ...] = ()  # all that are known
    plan: Plan | None = None  # the one in force at this frame

    @property
    def time(self) -> float:
        """[s] of the frame."""
        return self.vehicle.stamp * 1e-9


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
    state: State
    reason: str
    progress: Progress
