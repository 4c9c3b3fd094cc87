"""Logs of missions, made up."""

from __future__ import annotations

import math

import numpy as np

from rover_common.geometry import Pose
from rover_common.types import GridMap, RockTrack
from rover_tools.evaluation.results import Truth
from rover_tools.report.mission_log import LogBuilder, MissionLog, Moment

ROOM = np.zeros((200, 200), bool)
ROOM[60:90, 40:120] = True
TRUTH = Truth(ROOM, np.array([(100.0, 75.0)]))
FPS = 10
ROCK = RockTrack(1, 100.3, 75.4, (0.04, 0.0, 0.0, 0.01), 12, 0)


def grid_of(mapped: np.ndarray) -> GridMap:
    """A map on which these cells (200, 200) are navigable, and all others unknown."""
    return GridMap(1.0, 0.0, 0.0, np.where(mapped, 0, -1).astype(np.int8))


def moment_at(time: float, **changes) -> Moment:
    """Driving east at 1 m/s, back from the fortieth second on."""
    back = time > 40.0
    values = {
        "time": time,
        "pose": Pose(45.0 + (80.0 - time if back else time), 75.0, math.pi * back),
        "speed": 1.0,
        "state": "RETURN_HOME" if back else "FORWARD",
        "reason": "nothing is left" if back else "drives to a frontier",
        "samples": int(time > 30.0),
        "home_distance": 80.0 - time if back else time,
        "distance": time,
        "explored": time / 100.0,
    }
    return Moment(**values | changes)


def mission_log(truth: Truth = TRUTH, seconds: float = 80.0) -> MissionLog:
    """There and back; three quarters of the ground are mapped in the end."""
    builder = LogBuilder(truth)
    cells = np.argwhere(ROOM)
    mapped = np.zeros_like(ROOM)
    for frame in range(int(seconds * FPS) + 1):
        time = frame / FPS
        share = cells[: round(0.75 * len(cells) * time / seconds)]
        mapped[share[:, 0], share[:, 1]] = True
        builder.add(moment_at(time), lambda: grid_of(mapped))
    result = {
        "reason": "home", "time": seconds, "samples_collected": 1, "samples_total": 1,
        "percent_mapped": None, "done": True,
    }  # fmt: skip
    return builder.log("seed-1, tour", grid_of(mapped), (ROCK,), result)
