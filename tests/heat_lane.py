"""A maze in which a heat mission takes 70 s: a lane with a source and a ramp."""

from __future__ import annotations

from burger_simulator.world.maze import HeatSource, Maze, Ramp, SensorErrors, Wall
from rover_common.geometry import Pose

WEST, EAST, SIDE = -0.5, 2.2, 0.33  # [m] of the lane


def lane() -> Maze:
    """A source behind the robot, and a ramp before it, which it meets without having seen it."""
    walls = (
        Wall(WEST, -SIDE, EAST, -SIDE),
        Wall(EAST, -SIDE, EAST, SIDE),
        Wall(EAST, SIDE, WEST, SIDE),
        Wall(WEST, SIDE, WEST, -SIDE),
    )
    source = HeatSource(x=WEST + 0.0025, y=0.0, normal=0.0, height=0.12, sigma=0.1, excess=10.0)
    ramp, start = Ramp(0.3, 0.0, 0.0, "north-east"), Pose(0.0, 0.0, 0.0)
    size = (EAST - WEST, 2 * SIDE)
    return Maze("lane", *size, walls, (source,), ramp, start, 23.0, SensorErrors())
