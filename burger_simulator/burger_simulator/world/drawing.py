"""`python -m burger_simulator.world.drawing FILE.png [FAMILY]`: twelve mazes from above."""

from __future__ import annotations

import math
import sys

import cv2
import numpy as np
from numpy.typing import NDArray

from burger_simulator.world.families import FAMILIES
from burger_simulator.world.generator import generate_maze
from burger_simulator.world.maze import HeatSource, Maze, Ramp
from rover_common.burger import BURGER

SEEDS = range(1, 13)
COLUMNS = 4
SCALE = 100  # pixels per metre
MARGIN = 0.1  # [m]
# RGB
GROUND, WALL, TEXT = (240, 238, 232), (45, 50, 60), (90, 90, 90)
HEAT, ROBOT, SLOPE, FLAT = (215, 60, 40), (40, 110, 200), (200, 205, 180), (170, 180, 140)

Image = NDArray[np.uint8]


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    if not 1 <= len(arguments) <= 2 or (arguments[1:] and arguments[1] not in FAMILIES):
        print(f"{__doc__}\nfamilies: {', '.join(FAMILIES)}", file=sys.stderr)
        return 2
    family = arguments[1] if arguments[1:] else "challenge"
    tiles = [draw_maze(generate_maze(seed, family)) for seed in SEEDS]
    rows = [np.hstack(tiles[i : i + COLUMNS]) for i in range(0, len(tiles), COLUMNS)]
    cv2.imwrite(arguments[0], cv2.cvtColor(np.vstack(rows), cv2.COLOR_RGB2BGR))
    return 0


def draw_maze(maze: Maze) -> Image:
    """(rows, cols, 3) RGB, north up: walls, ramp, warm patches with their side, robot at start."""
    shape = (_pixels(maze.height + 2 * MARGIN), _pixels(maze.width + 2 * MARGIN), 3)
    image = np.full(shape, GROUND, np.uint8)

    def at(x: float, y: float) -> tuple[int, int]:
        return _pixels(x + MARGIN), shape[0] - _pixels(y + MARGIN)

    if maze.ramp is not None:
        for first, last, color in _ramp_parts(maze.ramp):
            corners = [at(*_on_ramp(maze.ramp, a, c)) for a, c in _corners(first, last, maze.ramp)]
            cv2.fillPoly(image, [np.array(corners, np.int32)], color)
    for source in maze.sources:
        _draw_source(image, source, at(source.x, source.y))
    for wall in maze.walls:
        cv2.line(image, at(wall.x0, wall.y0), at(wall.x1, wall.y1), WALL, 2, cv2.LINE_AA)
    start = maze.start
    tip = at(start.x + 0.2 * math.cos(start.yaw), start.y + 0.2 * math.sin(start.yaw))
    cv2.circle(image, at(start.x, start.y), _pixels(BURGER.body_radius), ROBOT, 2, cv2.LINE_AA)
    cv2.line(image, at(start.x, start.y), tip, ROBOT, 2, cv2.LINE_AA)
    cv2.putText(image, maze.name, (14, 26), cv2.FONT_HERSHEY_SIMPLEX, 0.45, TEXT, 1, cv2.LINE_AA)
    return image


def _draw_source(image: Image, source: HeatSource, middle: tuple[int, int]) -> None:
    """Half a disc of two sigma on the warm side."""
    angle = -math.degrees(source.normal)
    radius = _pixels(2 * source.sigma)
    cv2.ellipse(image, middle, (radius, radius), angle, -90, 90, HEAT, -1, cv2.LINE_AA)


def _ramp_parts(ramp: Ramp) -> list[tuple[float, float, tuple[int, int, int]]]:
    top, end = ramp.slope_length, ramp.slope_length + ramp.flat_length
    return [(0.0, top, SLOPE), (top, end, FLAT), (end, ramp.length, SLOPE)]


def _corners(first: float, last: float, ramp: Ramp) -> list[tuple[float, float]]:
    side = ramp.width / 2
    return [(first, -side), (last, -side), (last, side), (first, side)]


def _on_ramp(ramp: Ramp, along: float, across: float) -> tuple[float, float]:
    cos, sin = math.cos(ramp.yaw), math.sin(ramp.yaw)
    return ramp.x + cos * along - sin * across, ramp.y + sin * along + cos * across


def _pixels(metres: float) -> int:
    return round(metres * SCALE)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
