"""The figures by which a heat mission is accepted, each of what is true and what was reported."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree
from scipy.spatial.distance import cdist

from burger_simulator.truth import Launch, stands_on_flat
from burger_simulator.world.free_space import distances_to_walls
from burger_simulator.world.maze import HeatSource, Maze
from rover_common.geometry import Pose, bearing_to, compose_points
from rover_common.map_encoding import EDGE
from rover_common.types import GridMap
from rover_heat.mission.chart import State
from rover_tools.evaluation.heat_ticks import HeatTicks
from rover_tools.evaluation.scoring import score_places

FOUND = 0.15  # [m] from a true source
AT_STAND_OFF = 0.12  # [m] from a stand-off pose
# Where the first one cannot be reached, another one is: farther from the wall, or off its normal.
FARTHER, OFF_NORMAL = 0.05, math.radians(20.0)  # [m], [rad]
FACING = math.radians(10.0)  # off the source
STANDS, TURNS = 0.01, 0.03  # [m/s], [rad/s] of a robot that stands
ON_WALL = 0.05  # [m] from a wall that is right on the map
PERIOD = 1.0  # [s] between two poses that count

Points = NDArray[np.float64]  # (n, 2) [m] in the world frame


@dataclass(frozen=True)
class SourceScore:
    """Reported sources matched one to one with the true ones."""

    found: int  # true sources that were reported within FOUND
    false: int  # reported ones that belong to no true source, or to one that has another
    error_max: float | None  # [m] the farthest a true source is from the nearest reported one


@dataclass(frozen=True)
class LaunchScore:
    """Payloads released, against the stand-off poses of the true sources."""

    delivered: int  # sources that have theirs
    wrong: int  # launches that served none
    error_max: float | None  # [m] from a stand-off pose, of those that were not on the ramp
    angle_max: float | None  # [rad] off the source, of the same
    moving: int  # launches of a robot that did not stand
    on_ramp: bool  # one was released standing on the ramp's flat part


@dataclass(frozen=True)
class WallScore:
    """[%]"""

    right: float | None  # occupied cells within ON_WALL of a wall
    mapped: float | None  # walls with an occupied cell within ON_WALL


def score_sources(maze: Maze, reported: Points) -> SourceScore:
    true = np.array([(source.x, source.y) for source in maze.sources], float).reshape(-1, 2)
    matched = score_places(reported, true, FOUND)
    error = None
    if len(true) and len(reported):
        error = float(cdist(true, reported).min(axis=1).max())
    return SourceScore(matched.located, matched.false, error)


def score_launches(maze: Maze, launches: Sequence[Launch], stand_off: float) -> LaunchScore:
    """stand_off [m]: from the warm face to where the mission stands.

    A source at the ramp is served from the ramp's flat part. A second launch for the same source
    serves none.
    """
    on_walls = [source for source in maze.sources if not source.at_ramp]
    served: set[HeatSource] = set()
    wrong, errors, angles, on_ramp = 0, [], [], False
    for launch in launches:
        if stands_on_flat(maze.ramp, launch.pose) and _stands(launch) and not on_ramp:
            on_ramp = True
            continue
        nearest = min(on_walls, key=lambda s: _aside(launch, s, stand_off), default=None)
        if nearest is not None:
            errors.append(_aside(launch, nearest, stand_off))
            angles.append(_angle(launch, nearest))
        if nearest is None or nearest in served or not _serves(launch, nearest, stand_off):
            wrong += 1
        else:
            served.add(nearest)
    from_ramp = sum(source.at_ramp for source in maze.sources) if on_ramp else 0
    return LaunchScore(
        delivered=len(served) + from_ramp,
        wrong=wrong,
        error_max=max(errors, default=None),
        angle_max=max(angles, default=None),
        moving=sum(not _stands(launch) for launch in launches),
        on_ramp=on_ramp,
    )


def early_ascent(ticks: HeatTicks) -> float:
    """[m] The farthest that the axle was beyond the ramp's foot before the ramp was attempted."""
    attempts = np.flatnonzero(ticks.state == State.ATTEMPTING_RAMP)
    before = attempts[0] if len(attempts) else len(ticks.state)
    return float(ticks.beyond_foot[:before].max(initial=0.0))


def stop_seconds(ticks: HeatTicks) -> float | None:
    """[s] The longest from a tilt interrupt to a robot that stands; None without an interrupt."""
    interrupted = ticks.state == State.TILT_INTERRUPT
    starts = np.flatnonzero(interrupted & ~np.r_[False, interrupted[:-1]])
    standing = np.abs(ticks.speed) < STANDS
    longest: float | None = None
    for start in starts.tolist():
        rest = np.flatnonzero(standing[start:])
        stop = start + rest[0] if len(rest) else len(ticks.time) - 1
        longest = max(longest or 0.0, float(ticks.time[stop] - ticks.time[start]))
    return longest


def explored(ticks: HeatTicks) -> float | None:
    """[%] Of the reachable faces, as the mission had it when it explored last."""
    values = ticks.explored[ticks.state == State.EXPLORING]
    return 100.0 * float(values[-1]) if len(values) else None


def pose_rmse(ticks: HeatTicks) -> float | None:
    """[m] Of the estimated positions against the true ones, once a second."""
    seconds = np.flatnonzero(np.diff(ticks.time // PERIOD, prepend=-1.0) > 0)
    errors = (ticks.true - ticks.estimated)[seconds, :2]
    errors = errors[np.isfinite(errors).all(axis=1)]
    return float(np.sqrt((errors**2).sum(axis=1).mean())) if len(errors) else None


def score_walls(maze: Maze, grid: GridMap | None, map_in_world: Pose) -> WallScore:
    """The map's occupied cells against the true walls."""
    cells = np.empty((0, 2)) if grid is None else occupied(grid, map_in_world)
    if len(cells) == 0:
        return WallScore(None, None)
    away = distances_to_walls(cells[:, 0], cells[:, 1], maze.walls)
    points = np.concatenate([
        np.linspace((w.x0, w.y0), (w.x1, w.y1), max(2, math.ceil(w.length / ON_WALL)))
        for w in maze.walls
    ])  # fmt: skip
    to_cells, _ = KDTree(cells).query(points)
    right, mapped = np.mean(away <= ON_WALL), np.mean(to_cells <= ON_WALL)
    return WallScore(100.0 * float(right), 100.0 * float(mapped))


def occupied(grid: GridMap, map_in_world: Pose) -> Points:
    """The middles of the occupied cells."""
    rows, cols = np.nonzero(grid.cells > EDGE)
    corner = np.array([grid.origin_x, grid.origin_y])
    middles = corner + (np.column_stack([cols, rows]) + 0.5) * grid.resolution
    return compose_points(map_in_world, middles)


def _serves(launch: Launch, source: HeatSource, stand_off: float) -> bool:
    """Whether it was made at the source's stand-off pose, standing, and facing the source."""
    faces = _angle(launch, source) <= FACING
    return faces and _stands(launch) and _aside(launch, source, stand_off) <= AT_STAND_OFF


def _stands(launch: Launch) -> bool:
    return abs(launch.speed) < STANDS and abs(launch.turn_rate) < TURNS


def _angle(launch: Launch, source: HeatSource) -> float:
    """[rad] Between the robot's heading and the source."""
    return abs(bearing_to(launch.pose, source.x, source.y))


def _aside(launch: Launch, source: HeatSource, stand_off: float) -> float:
    """[m] From the nearest stand-off pose; they lie on the source's warm side."""
    angles = source.normal + np.array([0.0, OFF_NORMAL, -OFF_NORMAL])
    distances = np.array([stand_off, stand_off + FARTHER])[:, None]
    x = source.x + distances * np.cos(angles)
    y = source.y + distances * np.sin(angles)
    return float(np.hypot(launch.pose.x - x, launch.pose.y - y).min())
