"""A maze with the robot in it, as MJCF, MuJoCo's model format."""

from __future__ import annotations

import math
from xml.etree.ElementTree import Element, SubElement, tostring

import mujoco

from burger_simulator.model.robot import add_motors, add_robot, wxyz
from burger_simulator.world.maze import WALL_HEIGHT, WALL_THICKNESS, Maze, Ramp, Wall
from rover_common.geometry import Pose

STEP = 0.005  # [s] of the physics: the periods of all sensors but odometry are multiples of it
SLAB = 0.08  # [m] half of it thick, the ramp reaches below the ground everywhere


def model_of(maze: Maze, box: bool = False) -> mujoco.MjModel:
    """`box`: the robot as a box of 0.27 x 0.30 m instead of a disc."""
    return mujoco.MjModel.from_xml_string(mjcf_of(maze, box))


def mjcf_of(maze: Maze, box: bool = False) -> str:
    model = Element("mujoco", model=maze.name)
    SubElement(model, "compiler", angle="radian")
    SubElement(
        model, "option", timestep=str(STEP), integrator="implicitfast", cone="elliptic",
        impratio="10",  # wheels that hold do not creep
    )  # fmt: skip
    world = SubElement(model, "worldbody")
    SubElement(world, "geom", name="floor", type="plane", size="0 0 1")
    for index, wall in enumerate(maze.walls):
        _add_wall(world, f"wall_{index}", wall)
    if maze.ramp is not None:
        _add_ramp(world, maze.ramp)
    height = 0.0 if maze.ramp is None else maze.ramp.height_at(maze.start.x, maze.start.y)
    add_robot(world, maze.start, height, maze.errors, box)
    add_motors(model)
    return tostring(model, encoding="unicode")


def _add_wall(world: Element, name: str, wall: Wall) -> None:
    """Longer by its thickness, so that walls that meet leave no gap."""
    half = (wall.length + WALL_THICKNESS) / 2, WALL_THICKNESS / 2, WALL_HEIGHT / 2
    x, y = (wall.x0 + wall.x1) / 2, (wall.y0 + wall.y1) / 2
    SubElement(
        world, "geom", name=name, type="box", size=f"{half[0]} {half[1]} {half[2]}",
        pos=f"{x} {y} {WALL_HEIGHT / 2}", quat=wxyz(Pose(x, y, wall.yaw)),
    )  # fmt: skip


def _add_ramp(world: Element, ramp: Ramp) -> None:
    """Three boxes whose upper faces are the slope up, the flat part and the slope down."""
    angle = math.atan2(ramp.height, ramp.slope_length)
    slope = math.hypot(ramp.height, ramp.slope_length)
    middles = (ramp.slope_length / 2, ramp.length / 2, ramp.length - ramp.slope_length / 2)
    lengths = (slope, ramp.flat_length, slope)
    heights = (ramp.height / 2, ramp.height, ramp.height / 2)
    pitches = (-angle, 0.0, angle)
    parts = zip(("up", "flat", "down"), middles, lengths, heights, pitches, strict=True)
    for name, middle, length, height, pitch in parts:
        along = middle - math.sin(pitch) * SLAB / 2  # of the box's own middle
        z = height - math.cos(pitch) * SLAB / 2
        x = ramp.x + along * math.cos(ramp.yaw)
        y = ramp.y + along * math.sin(ramp.yaw)
        SubElement(
            world, "geom", name=f"ramp_{name}", type="box",
            size=f"{length / 2} {ramp.width / 2} {SLAB / 2}", pos=f"{x} {y} {z}",
            quat=wxyz(Pose(x, y, ramp.yaw, pitch)),
        )  # fmt: skip
