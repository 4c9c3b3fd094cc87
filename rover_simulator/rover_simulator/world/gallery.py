"""`python -m rover_simulator.world.gallery FILE.png`: twelve generated canyons from above."""

from __future__ import annotations

import sys

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_simulator.world.generator import generate_world
from rover_simulator.world.world import World

SEEDS = range(1, 13)
COLUMNS = 4
SCALE = 2  # pixels per metre
# RGB
GROUND, WALL, FRAME = (240, 225, 211), (60, 48, 42), (255, 255, 255)
BOULDER, SAMPLE, START = (17, 13, 10), (230, 180, 0), (40, 120, 200)


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    tiles = [draw(generate_world(seed)) for seed in SEEDS]
    rows = [np.hstack(tiles[i : i + COLUMNS]) for i in range(0, len(tiles), COLUMNS)]
    cv2.imwrite(arguments[0], cv2.cvtColor(np.vstack(rows), cv2.COLOR_RGB2BGR))
    return 0


def draw(world: World) -> NDArray[np.uint8]:
    """North up; ground, boulders, samples, start."""
    colors = np.array([WALL, GROUND], np.uint8)[world.navigable.astype(int)]
    image = colors.repeat(SCALE, axis=0).repeat(SCALE, axis=1)
    for boulder in world.boulders:
        _dot(image, boulder.x, boulder.y, SCALE, BOULDER)
    for x, y in world.samples:
        _dot(image, float(x), float(y), 2 * SCALE, SAMPLE)
    _dot(image, world.start.x, world.start.y, 2 * SCALE, START)
    upright = np.ascontiguousarray(image[::-1])
    cv2.rectangle(upright, (0, 0), (image.shape[1] - 1, image.shape[0] - 1), FRAME, 2)
    return upright


def _dot(image: NDArray, x: float, y: float, radius: int, color: tuple[int, int, int]) -> None:
    cv2.circle(image, (round(x * SCALE), round(y * SCALE)), radius, color, -1, cv2.LINE_AA)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
