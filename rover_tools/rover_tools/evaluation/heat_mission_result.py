"""A heat mission's result: the same for the graph and for the loop."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from burger_simulator.truth import Truth
from burger_simulator.world.maze import Maze
from rover_common.geometry import Pose, compose_points
from rover_common.types import GridMap
from rover_heat.mission.chart import State
from rover_heat.types import HeatOverlay, HeatSource
from rover_tools.evaluation.heat_score import (
    early_ascent,
    explored,
    pose_rmse,
    score_launches,
    score_sources,
    score_walls,
    stop_seconds,
)
from rover_tools.evaluation.heat_setup import HeatSetup
from rover_tools.evaluation.heat_ticks import START_TIME, HeatTicks
from rover_tools.evaluation.results import Result


@dataclass(frozen=True)
class HeatRun:
    """A mission that ended: what it reports, and what is true."""

    state: State
    reason: str
    interrupts: int  # stops because of tilt, as reported
    overlay: HeatOverlay  # with the sources as reported, in the map
    grid: GridMap | None
    map_in_world: Pose  # the map's frame
    ticks: HeatTicks
    truth: Truth  # at the end

    @property
    def time(self) -> float:
        """[s] since the simulator began."""
        return self.truth.time - START_TIME


def heat_mission_result(
    maze: Maze, seed: int, setup: HeatSetup, run: HeatRun, wall_seconds: float
) -> Result:
    """The result of one mission; `success` asks for all that a mission is for."""
    sources = score_sources(maze, _places(run.overlay.sources, run.map_in_world))
    launches = score_launches(maze, run.truth.launches, setup.config.stand_off)
    contacts = run.truth.contacts + run.truth.ramp_contacts
    ramp_done = None if maze.ramp is None else launches.on_ramp and run.truth.ramp_contacts == 0
    done, total = run.state is State.DONE, len(maze.sources)
    in_time = done and run.time < setup.config.time_limit
    success = (
        sources.found == launches.delivered == total
        and sources.false == 0
        and ramp_done is not False
        and contacts == 0
        and in_time
    )
    return {
        "success": success,
        "done": done,
        "in_time": in_time,
        "reason": run.reason,
        "time": round(run.time, 1),
        "sources_total": total,
        "sources_found": sources.found,
        "sources_false": sources.false,
        "source_error_max": _rounded(sources.error_max),
        "delivered": launches.delivered,
        "launches_wrong": launches.wrong,
        "launches_moving": launches.moving,
        "launch_error_max": _rounded(launches.error_max),
        "launch_angle_max": _rounded(_degrees(launches.angle_max), 1),
        "ramp_done": ramp_done,
        "contacts": contacts,
        **_measured(maze, run),
        "world": maze.name,
        "seed": seed,
        "parameters": setup.label,
        "wall_seconds": round(wall_seconds, 1),
    }


def _measured(maze: Maze, run: HeatRun) -> Result:
    """What does not decide about success."""
    walls = score_walls(maze, run.grid, run.map_in_world)
    return {
        "early_ascent": round(early_ascent(run.ticks), 3),
        "interrupts": run.interrupts,
        "stop_seconds_max": _rounded(stop_seconds(run.ticks)),
        "pose_rmse": _rounded(pose_rmse(run.ticks), 4),
        "walls_right": _rounded(walls.right, 1),
        "walls_mapped": _rounded(walls.mapped, 1),
        "explored": _rounded(explored(run.ticks), 1),
        "distance": round(run.truth.distance, 1),
    }


HEAT_RESULT_KEYS = (
    "success", "done", "in_time", "reason", "time", "sources_total", "sources_found",
    "sources_false", "source_error_max", "delivered", "launches_wrong", "launches_moving",
    "launch_error_max", "launch_angle_max", "ramp_done", "contacts", "early_ascent", "interrupts",
    "stop_seconds_max", "pose_rmse", "walls_right", "walls_mapped",
    "explored", "distance", "world", "seed", "parameters", "wall_seconds",
)  # fmt: skip


def failed_heat_result(world: str, seed: int, label: str, error: str) -> Result:
    """The result of a mission that did not end: nothing is known but the error."""
    known = {"success": False, "done": False, "reason": f"failed: {error}"}
    known |= {"world": world, "seed": seed, "parameters": label}
    return dict.fromkeys(HEAT_RESULT_KEYS) | known


def _places(sources: Sequence[HeatSource], map_in_world: Pose) -> np.ndarray:
    places = np.array([(source.x, source.y) for source in sources], float).reshape(-1, 2)
    return compose_points(map_in_world, places)


def _degrees(angle: float | None) -> float | None:
    return None if angle is None else math.degrees(angle)


def _rounded(value: float | None, digits: int = 3) -> float | None:
    return None if value is None else round(value, digits)
