"""A robot's requests while it maps random ground: views here and there, a trail, blocked places."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from maps import NO_DISCS

from rover_common.geometry import Pose
from rover_common.map_encoding import EDGE
from rover_common.types import GridMap
from rover_navigation.types import NO_POINTS, BlockedPlace, PlanRequest

SIDE = 120  # [cells] of the map
VALUES = np.array([0, 0, 0, 100, EDGE, -1], np.int8)


def requests(seed: int, count: int, rows: int = SIDE, cols: int = SIDE) -> Iterator[PlanRequest]:
    """Each shows a patch more of random ground, or forgets one, around a robot that walks."""
    random = np.random.default_rng(seed)
    ground = _ground(random, rows, cols)
    cells = np.full((rows, cols), -1, np.int8)
    trail, blocked = NO_POINTS, ()
    x, y = 0.25 * random.uniform(10, cols - 10), 0.25 * random.uniform(10, rows - 10)
    for stamp in range(count):
        row, col = int(4 * y) + random.integers(-9, 9), int(4 * x) + random.integers(-9, 9)
        seen = _around(row, col, int(random.integers(4, 20)))
        cells = cells.copy()
        cells[seen] = ground[seen]
        cells[_around(int(4 * y), int(4 * x), 3)] = 0  # it knows the ground that it drives on
        if random.random() < 0.2:
            cells[_around(*random.integers(0, (rows, cols)), 3)] = random.choice(VALUES)
        trail = np.concatenate([trail, [(x, y)]])
        blocked = tuple(place for place in blocked if random.random() < 0.7)
        if random.random() < 0.3:
            blocked += (BlockedPlace(x + 1.0, y, 0.5),)  # ahead of the robot, as they always are
        pose = Pose(x, y, 0.0)
        grid = GridMap(0.25, 0.0, 0.0, cells)
        made = PlanRequest(grid, stamp, pose, (trail[0, 0], trail[0, 1]), trail, blocked=blocked)
        yield replace(made, blacklisted=NO_DISCS)
        x = float(np.clip(x + random.uniform(-1.5, 1.5), 0.1, 0.25 * cols - 0.1))
        y = float(np.clip(y + random.uniform(-1.5, 1.5), 0.1, 0.25 * rows - 0.1))


def _ground(random: np.random.Generator, rows: int, cols: int) -> np.ndarray:
    """Mostly free, in blocks of eight cells."""
    blocks = random.choice(VALUES, (rows // 8 + 1, cols // 8 + 1))
    return blocks.repeat(8, 0).repeat(8, 1)[:rows, :cols]


def _around(row: int, col: int, reach: int) -> tuple[slice, slice]:
    return (
        slice(max(0, row - reach), max(0, row + reach)),
        slice(max(0, col - reach), max(0, col + reach)),
    )
