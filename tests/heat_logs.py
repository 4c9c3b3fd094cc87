"""Logs of heat missions, made up: in the room of heat_runs, one that achieved everything."""

from __future__ import annotations

import math

import numpy as np
from heat_runs import MAZE, START, TRUTH, map_of, reported, result_of

from rover_common.geometry import Pose
from rover_heat.ramp.hazards import Hazards, Strip
from rover_heat.types import HeatOverlay
from rover_navigation.types import BlockedPlace
from rover_tools.report.heat_log import HeatLog, HeatLogBuilder, HeatMoment

SECONDS = 80
WARM = np.full((8, 8), 23.0, np.float32)
WARM[3, 6] = 29.0  # in the second column from the right
COLD = np.full((8, 8), 24.0, np.float32)
FACES = np.array([(0.5, 0.99), (0.6, 0.99)])  # [m] map frame, on the west wall
OVERLAY = HeatOverlay(
    sources=(reported(0.0, 2.0), reported(3.0, 4.0)),
    hazards=Hazards(
        (Strip(Pose(1.0, -2.0, 0.0), 1.25, 0.5),), (BlockedPlace(1.0, -2.0, 0.2),)
    ),
    faces=FACES,
    open_faces=FACES + np.array([1.0, 0.0]),
    goal=Pose(1.0, 0.0, 0.0),
)  # fmt: skip


def moment_at(time: float, **changes) -> HeatMoment:
    """Driving along the map's x axis at 0.02 m/s, back from the fortieth second on."""
    back = time > 40.0
    values = {
        "time": time,
        "pose": Pose(0.02 * (80.0 - time if back else time), 0.0, math.pi * back),
        "speed": 0.02,
        "state": "GOAL_NAVIGATION" if back else "EXPLORING",
        "reason": "drives to a source" if back else "drives to a frontier",
        "sources_known": int(time > 30.0),
        "sources_delivered": 0,
        "payloads": 4,
        "distance": 0.02 * time,
        "explored": time / 100.0,
        "thermal": (COLD, WARM),
        "error": 0.01,
    }
    return HeatMoment(**values | changes)


def heat_log(truth: bool = True, grid: bool = True, **changes) -> HeatLog:
    """There and back."""
    builder = HeatLogBuilder()
    for tick in range(SECONDS * 10 + 1):
        builder.add(moment_at(tick / 10, **changes))
    cells = np.zeros((40, 40))
    cells[19] = 100  # along x, at y from 0.95 to 1.00: the west wall
    known = map_of(cells) if grid else None
    if not truth:
        return builder.log("recording", known, OVERLAY, {"reason": "the mission is over"})
    return builder.log("room-1, heat", known, OVERLAY, result_of(), MAZE, START, TRUTH.launches)
