"""Draws the maze of a seed, by the drawing of the challenge."""

from __future__ import annotations

import zlib
from dataclasses import replace

import numpy as np
from numpy.random import Generator, default_rng

from burger_simulator.world.families import FAMILIES, Family
from burger_simulator.world.layout import Layout, draw_layout
from burger_simulator.world.maze import Maze, MazeError, SensorErrors, Wall
from burger_simulator.world.source_placement import place_sources, source_at_ramp
from rover_common.geometry import Pose

AIR = (22.0, 25.5)  # [C]
THERMAL_OFFSET = 1.25  # [K] sigma: the data sheet's accuracy of 2.5 K as two of them
GYRO_BIAS = 0.002  # [rad/s] sigma
LEVEL_BIAS = np.radians(0.5)  # [rad] sigma
WHEEL_SEPARATION, WHEEL_RADIUS = 0.01, 0.005  # within these shares of the nominal ones
START_YAW = 0.1  # [rad] sigma, around the lane's direction
LAYOUTS = 20  # a layout without a place for all sources is drawn again


def generate_maze(seed: int, family: str = "challenge", sources: int | None = None) -> Maze:
    """The maze of a seed; `sources` in it, beside one at the ramp, instead of a drawn number.

    Raises MazeError for a family that is not known, and when so many sources found no place.
    """
    if family not in FAMILIES:
        raise MazeError(f"family '{family}' is not one of {', '.join(FAMILIES)}")
    chosen = FAMILIES[family]
    random = default_rng((seed, zlib.crc32(family.encode())))
    fewest, most = chosen.sources
    count = int(random.integers(fewest, most + 1)) if sources is None else sources
    at_ramp = bool(random.random() < chosen.ramp_source)
    for _ in range(LAYOUTS):
        maze = _without_sources(f"{family}-{seed}", chosen, random)
        if maze.ramp is not None and at_ramp:
            wall_y = maze.height if maze.ramp.corner == "north-east" else 0.0
            maze = replace(maze, sources=(source_at_ramp(maze.ramp, wall_y, random),))
        placed = place_sources(maze, count, random)
        if len(placed) == count:
            return replace(maze, sources=placed + maze.sources)
    raise MazeError(f"no maze '{family}' of seed {seed} has room for {count} sources")


def _without_sources(name: str, family: Family, random: Generator) -> Maze:
    layout = draw_layout(family, random)
    if random.random() < 0.5:
        layout = _mirrored(layout, family.height)
    yaw = layout.start_yaw + random.normal(0.0, START_YAW)
    return Maze(
        name=name,
        width=family.width,
        height=family.height,
        walls=layout.walls,
        sources=(),
        ramp=layout.ramp,
        start=Pose(layout.start_x, layout.start_y, float(yaw)),
        air=float(random.uniform(*AIR)),
        errors=_errors(random),
    )


def _mirrored(layout: Layout, height: float) -> Layout:
    """South for north."""
    ramp = layout.ramp
    return Layout(
        walls=tuple(Wall(w.x0, height - w.y0, w.x1, height - w.y1) for w in layout.walls),
        ramp=ramp and replace(ramp, y=height - ramp.y, yaw=-ramp.yaw, corner="south-east"),
        start_x=layout.start_x,
        start_y=height - layout.start_y,
        start_yaw=-layout.start_yaw,
    )


def _errors(random: Generator) -> SensorErrors:
    offsets = np.clip(
        random.normal(0.0, THERMAL_OFFSET, 2), -2 * THERMAL_OFFSET, 2 * THERMAL_OFFSET
    )
    bias = random.normal(0.0, GYRO_BIAS, 3)
    pitch, roll = random.normal(0.0, LEVEL_BIAS, 2)
    return SensorErrors(
        thermal_offsets=(float(offsets[0]), float(offsets[1])),
        gyro_bias=(float(bias[0]), float(bias[1]), float(bias[2])),
        level_pitch=float(pitch),
        level_roll=float(roll),
        wheel_separation_scale=float(1.0 + random.uniform(-WHEEL_SEPARATION, WHEEL_SEPARATION)),
        wheel_radius_scale=float(1.0 + random.uniform(-WHEEL_RADIUS, WHEEL_RADIUS)),
    )
