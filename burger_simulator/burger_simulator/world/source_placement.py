"""Puts heat sources on faces that the robot can stand before."""

from __future__ import annotations

import math

import numpy as np
from numpy.random import Generator

from burger_simulator.world.free_space import FreeSpace, distances_to_walls
from burger_simulator.world.maze import WALL_THICKNESS, HeatSource, Maze, Ramp, Wall
from rover_common.burger import BURGER

APART = 0.8  # [m] least between two sources
FROM_CORNER = 0.2  # [m] least from a wall's end and from every other wall
FROM_START = 0.6  # [m]
STAND_OFF = 0.30  # [m] before the face, where a mission stands
ATTEMPTS = 400
SIGMA = (0.08, 0.14)  # [m]
EXCESS = (6.0, 12.0)  # [K] what other teams read
HEIGHT = (0.17, 0.23)  # [m] around 0.2


def place_sources(maze: Maze, count: int, random: Generator) -> tuple[HeatSource, ...]:
    """So many, or fewer where ATTEMPTS draws have found no place for the next one.

    Sources that the maze has already are kept away from, and are not among those returned.
    """
    space = FreeSpace(maze, BURGER.body_radius)
    lengths = np.array([wall.length for wall in maze.walls])
    placed: list[HeatSource] = []
    for _ in range(ATTEMPTS):
        if len(placed) == count:
            break
        index = int(random.choice(len(lengths), p=lengths / lengths.sum()))
        side, share = float(random.choice((-1.0, 1.0))), random.random()
        wall = maze.walls[index]
        others = maze.walls[:index] + maze.walls[index + 1 :]
        source = _on_face(wall, share * wall.length, side, random)
        if (
            _clear_of_corners(wall, share * wall.length, others)
            and _stands_before(source, space)
            and _far_from_all(source, maze, placed)
        ):
            placed.append(source)
    return tuple(placed)


def source_at_ramp(ramp: Ramp, wall_y: float, random: Generator) -> HeatSource:
    """On the wall that the ramp leads to, as high above its flat part as others above ground."""
    up = math.sin(ramp.yaw)
    return HeatSource(
        x=ramp.x,
        y=wall_y - up * WALL_THICKNESS / 2,
        normal=-math.copysign(math.pi / 2, up),
        height=ramp.height + random.uniform(*HEIGHT),
        sigma=random.uniform(*SIGMA),
        excess=random.uniform(*EXCESS),
        at_ramp=True,
    )


def _on_face(wall: Wall, along: float, side: float, random: Generator) -> HeatSource:
    normal = wall.yaw + side * math.pi / 2
    return HeatSource(
        x=wall.x0 + along * math.cos(wall.yaw) + WALL_THICKNESS / 2 * math.cos(normal),
        y=wall.y0 + along * math.sin(wall.yaw) + WALL_THICKNESS / 2 * math.sin(normal),
        normal=math.remainder(normal, 2.0 * math.pi),
        height=random.uniform(*HEIGHT),
        sigma=random.uniform(*SIGMA),
        excess=random.uniform(*EXCESS),
    )


def _clear_of_corners(wall: Wall, along: float, others: tuple[Wall, ...]) -> bool:
    x = wall.x0 + along * math.cos(wall.yaw)
    y = wall.y0 + along * math.sin(wall.yaw)
    to_others = float(distances_to_walls(np.array(x), np.array(y), others))
    return min(along, wall.length - along, to_others) >= FROM_CORNER


def _stands_before(source: HeatSource, space: FreeSpace) -> bool:
    x = source.x + STAND_OFF * math.cos(source.normal)
    y = source.y + STAND_OFF * math.sin(source.normal)
    return space.reaches(x, y)


def _far_from_all(source: HeatSource, maze: Maze, placed: list[HeatSource]) -> bool:
    from_start = math.hypot(source.x - maze.start.x, source.y - maze.start.y)
    others = (*maze.sources, *placed)
    nearest = min((math.hypot(source.x - o.x, source.y - o.y) for o in others), default=math.inf)
    return from_start >= FROM_START and nearest >= APART
