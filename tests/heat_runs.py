"""Runs of the heat mission, made up: a room with two sources and a ramp, and how it went."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from burger_simulator.truth import Launch, Truth
from burger_simulator.world.maze import HeatSource, Maze, Ramp, Wall
from rover_common.geometry import Pose
from rover_common.types import GridMap
from rover_heat.config import HeatConfig
from rover_heat.mission.chart import State
from rover_heat.types import HeatOverlay
from rover_heat.types import HeatSource as Reported
from rover_tools.evaluation.heat_mission_result import HeatRun, heat_mission_result
from rover_tools.evaluation.heat_setup import HeatSetup
from rover_tools.evaluation.heat_ticks import START_TIME, HeatTicks, TickLog

NORTH = math.pi / 2
START = Pose(1.0, 1.0, NORTH)  # of the robot, and of the map's frame
LEFT = HeatSource(0.0, 2.0, 0.0, 0.2, 0.1, 8.0)  # on the west wall, looking east
AT_RAMP = HeatSource(3.0, 4.0, -NORTH, 0.26, 0.1, 8.0, at_ramp=True)
MAZE = Maze(
    "room-1", 4.0, 4.0,
    (Wall(0, 0, 4, 0), Wall(4, 0, 4, 4), Wall(4, 4, 0, 4), Wall(0, 4, 0, 0)),
    (LEFT, AT_RAMP), Ramp(3.0, 2.0, NORTH, "north-east"), START, 23.0,
)  # fmt: skip
ON_TOP = Pose(3.0, 2.65, NORTH)  # the caster is above the flat part as well
SERVED = Launch(150.0, Pose(0.30, 2.0, math.pi), 0.0, 0.0)
ON_RAMP = Launch(240.0, ON_TOP, 0.0, 0.0)
TRUTH = Truth(
    START_TIME + 250.0, ON_TOP, 0.06, 0.0, 0.0, 20.0, 0, False, 0, 0.65, True, (SERVED, ON_RAMP)
)


def launch(pose: Pose, **changes) -> Launch:
    return replace(Launch(160.0, pose, 0.0, 0.0), **changes)


def reported(x: float, y: float) -> Reported:
    """At a place [m] of the world, which the map sees turned by a quarter about START."""
    return Reported(1, y - START.y, START.x - x, (0.0, 0.0, 0.0, 0.0), 0.0, 9, 6.0)


def ticks_of(*spans: tuple[State, float], **changes) -> HeatTicks:
    """Ten ticks a second; each span is a state and its seconds. `changes` by tick number."""
    log, time = TickLog(START), START_TIME
    for state, seconds in spans:
        for _ in range(round(seconds * 10)):
            truth = replace(TRUTH, time=time, pose=START, beyond_foot=0.0)
            log.add(truth, state, Pose(0.0, 0.0, 0.0), 0.9)
            time += 0.1
    return replace(log.ticks(), **changes)


def run_of(**changes) -> HeatRun:
    """One that achieved everything."""
    spans = (State.EXPLORING, 200.0), (State.ATTEMPTING_RAMP, 50.0)
    run = HeatRun(
        State.DONE, "the mission is over", 1,
        HeatOverlay(sources=(reported(0.0, 2.0), reported(3.0, 4.0))), None,
        START, ticks_of(*spans), TRUTH,
    )  # fmt: skip
    if "sources" in changes:
        changes["overlay"] = HeatOverlay(sources=changes.pop("sources"))
    return replace(run, **changes)


def result_of(maze: Maze = MAZE, time_limit: float = 1200.0, **changes) -> dict:
    setup = HeatSetup(config=HeatConfig(time_limit=time_limit))
    return heat_mission_result(maze, 1, setup, run_of(**changes), 9.0)


def map_of(cells: np.ndarray) -> GridMap:
    """Cells of 0.05 m, the first one's corner at the map's origin."""
    return GridMap(0.05, 0.0, 0.0, cells.astype(np.int8))
