"""Small worlds made by hand."""

from __future__ import annotations

import math

from burger_simulator.world.maze import HeatSource, Maze, Ramp, SensorErrors, Wall
from rover_common.geometry import Pose

NO_ERRORS = SensorErrors()
MIDDLE = Pose(0.0, 0.0, 0.0)


def square(
    half: float = 1.0,
    start: Pose = MIDDLE,
    sources: tuple[HeatSource, ...] = (),
    ramp: Ramp | None = None,
    errors: SensorErrors = NO_ERRORS,
    inner: tuple[Wall, ...] = (),
) -> Maze:
    """Four walls around the origin, a robot without errors of its own, air of 23 C."""
    walls = (
        Wall(-half, -half, half, -half),
        Wall(half, -half, half, half),
        Wall(half, half, -half, half),
        Wall(-half, half, -half, -half),
    )
    size = 2 * half
    return Maze("square", size, size, walls + inner, sources, ramp, start, 23.0, errors)


def warm_wall_ahead(half: float = 1.0, **others: float) -> HeatSource:
    """In the middle of the square's eastern wall."""
    values = {"height": 0.12, "sigma": 0.1, "excess": 10.0} | others
    return HeatSource(x=half - 0.0025, y=0.0, normal=math.pi, **values)


def ramp_ahead(distance: float = 0.5) -> Ramp:
    return Ramp(distance, 0.0, 0.0, "north-east")
