"""A heat mission tick by tick: what is true beside what the mission says of itself."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from burger_simulator.simulation import START
from burger_simulator.truth import Truth
from rover_common.geometry import Pose, compose
from rover_heat.mission.chart import State

START_TIME = START * 1e-9  # [s] of the simulator's clock when it begins
NOWHERE = (math.nan, math.nan, math.nan)


@dataclass(frozen=True)
class HeatTicks:
    """One row per tick of 0.05 s; poses are x, y, yaw in the world frame."""

    time: NDArray[np.float64]  # (n,) [s] since the simulator began
    state: NDArray[np.int64]  # (n,) values of State
    true: NDArray[np.float64]  # (n, 3) [m, rad]
    estimated: NDArray[np.float64]  # (n, 3) [m, rad], NaN before there is a pose
    speed: NDArray[np.float64]  # (n,) [m/s] true, forward positive
    beyond_foot: NDArray[np.float64]  # (n,) [m] of the axle beyond the ramp's foot
    explored: NDArray[np.float64]  # (n,) 0..1 of the reachable faces, as the mission has it


class TickLog:
    """Takes every tick of a mission."""

    def __init__(self, map_in_world: Pose) -> None:
        """map_in_world: the map's frame, which begins where the robot stands at first."""
        self._map_in_world = map_in_world
        self._rows: list[tuple[float, ...]] = []

    def add(self, truth: Truth, state: State, pose: Pose | None, explored: float) -> None:
        """pose: the estimated one in the map, None before there is one; explored: 0..1."""
        estimated = NOWHERE
        if pose is not None:
            placed = compose(self._map_in_world, pose)
            estimated = placed.x, placed.y, placed.yaw
        true, time = truth.pose, truth.time - START_TIME
        self._rows.append((
            time, float(state), true.x, true.y, true.yaw, *estimated,
            truth.speed, truth.beyond_foot, explored,
        ))  # fmt: skip

    def ticks(self) -> HeatTicks:
        rows = np.array(self._rows, float).reshape(-1, 11)
        return HeatTicks(
            time=rows[:, 0],
            state=rows[:, 1].astype(np.int64),
            true=rows[:, 2:5],
            estimated=rows[:, 5:8],
            speed=rows[:, 8],
            beyond_foot=rows[:, 9],
            explored=rows[:, 10],
        )
