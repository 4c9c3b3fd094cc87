"""Made frames for the classic solutions, and missions that are driven by them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from frames_by_hand import nanoseconds
from maps import MIDDLE
from scans import open_scan

from rover_common.geometry import Pose
from rover_common.types import PolarArray, VehicleState
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.classic.ground import CELL, Ground
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.mission import SampleReturnMission
from rover_decision.types import Decision, Frame, Request
from rover_navigation.plan_scheduler import PlanStatus
from rover_navigation.types import Plan

NEAREST, REACH = 0.6, 8.0  # [m] ahead that the top view shows
FIELD = math.radians(54.0)
STEP = 0.04  # [s] between two frames
AWAY = Pose(MIDDLE.x + 30.0, MIDDLE.y, 0.0)

Floor = Callable[[np.ndarray, np.ndarray], np.ndarray]


def open_floor(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.full_like(x, True, bool)


def no_floor(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.full_like(x, False, bool)


def nav(is_floor: Floor = open_floor) -> PolarArray:
    """Every cell of 0.1 m in view at whose place (x ahead, y left) [m] there is floor."""
    steps = np.arange(-REACH, REACH, CELL) + CELL / 2
    x, y = (axis.ravel() for axis in np.meshgrid(steps, steps))
    ranges, bearings = np.hypot(x, y), np.arctan2(y, x)
    seen = (x > NEAREST) & (np.abs(bearings) < FIELD) & (ranges < REACH) & is_floor(x, y)
    return PolarArray(ranges[seen].astype(np.float32), bearings[seen].astype(np.float32))


def ground(is_floor: Floor = open_floor) -> Ground:
    return Ground.of(nav(is_floor), CELL)


def patch(x: float, y: float, count: int) -> Floor:
    """As many cells of floor as asked for, those nearest to a place."""

    def is_floor(east: np.ndarray, north: np.ndarray) -> np.ndarray:
        distance = np.hypot(east - x, north - y)
        inside = np.zeros(len(distance), bool)
        inside[np.argsort(distance)[:count]] = True
        return inside

    return is_floor


def rock_at(*places: tuple[float, float]) -> PolarArray:
    """One rock cell at each place (x ahead, y left) [m]."""
    x, y = np.array(places, float).reshape(-1, 2).T
    return PolarArray(np.hypot(x, y).astype(np.float32), np.arctan2(y, x).astype(np.float32))


class ClassicMission:
    """Frames by hand; without a plan unless one is given."""

    def __init__(self, explorer: str, **parameters: Any) -> None:
        config = {"explorer": explorer, "nav_cell": CELL, "time_limit": 36000.0} | parameters
        self.mission = SampleReturnMission(DecisionConfig(**config))
        self.time = 1.0  # [s] of the next frame
        self.pose = AWAY
        self._start = True

    @property
    def state(self) -> State:
        return self.mission.state

    def tick(
        self,
        floor: Floor = open_floor,
        rock: PolarArray | None = None,
        plan: Plan | None = None,
        moves: float = 0.05,
        **vehicle: Any,
    ) -> Decision:
        """Decide about a frame; it moves so far [m] ahead before the next. The first is at home."""
        pose = vehicle.pop("pose", MIDDLE if self._start else self.pose)
        if not self._start:
            self.pose = Pose(
                pose.x + moves * math.cos(pose.yaw), pose.y + moves * math.sin(pose.yaw), pose.yaw
            )
        self._start = False
        fields: dict[str, Any] = {
            "speed": 0.0, "near_sample": False, "picking_up": False, "sample_count": 3
        }  # fmt: skip
        stamp = nanoseconds(self.time)
        state = VehicleState(stamp, pose, **(fields | vehicle))
        shown = Frame(state, nav(floor), open_scan(8.0), (), stamp, rock or PolarArray.empty())
        decision = self.mission.tick(shown, PlanStatus(plan))
        self.time += STEP
        return decision

    def ticks(self, seconds: float, **what: Any) -> list[Decision]:
        return [self.tick(**what) for _ in range(round(seconds / STEP))]

    def request(self, request: Request) -> bool:
        return self.mission.request(request)


def driving(explorer: str, **parameters: Any) -> ClassicMission:
    """A mission that drives, away from its start."""
    mission = ClassicMission(explorer, **parameters)
    mission.tick()
    mission.tick()
    assert mission.state is State.FORWARD
    return mission
