"""The walls of a maze: a lane with the start, cells from a spanning tree, a strip with the ramp.

Drawn with the ramp in the north-east; the generator mirrors half of them to the south-east.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from burger_simulator.world.families import LANE, STRIP, Family
from burger_simulator.world.maze import Ramp, Wall

JITTER = 0.04  # [m] of the lines of cells, so that passages differ; they stay above 0.5 m
OPENED = 0.35  # share of the walls that the spanning tree leaves which is taken out
RAMP_CLEARANCE = 0.25  # [m] from the ramp to the outer wall, by the challenge's drawing
APPROACH = 0.40  # [m] least, before the ramp's foot, along which the strip has no gap


@dataclass(frozen=True)
class Layout:
    walls: tuple[Wall, ...]
    ramp: Ramp | None
    start_x: float  # [m]
    start_y: float  # [m]
    start_yaw: float  # [rad] along the lane


def draw_layout(family: Family, random: Generator) -> Layout:
    xs = _lines(LANE, family.width - STRIP, family.columns, random)
    ys = _lines(0.0, family.height, family.rows, random)
    between_columns, between_rows = _cells(family.columns, family.rows, random)
    ramp = _ramp(family) if family.ramp else None
    start_south = random.random() < 0.5
    lane, strip = _lane_wall(family.rows, start_south, random), _strip_wall(ys, ramp, random)
    upright = np.vstack([lane, between_columns, strip])
    walls = [Wall(*ends) for ends in _outline(family)]
    for x, edges in zip(xs, upright, strict=True):
        walls += [Wall(x, ys[first], x, ys[end]) for first, end in _stretches(edges)]
    for y, edges in zip(ys[1:-1], between_rows, strict=True):
        walls += [Wall(xs[first], y, xs[end], y) for first, end in _stretches(edges)]
    start_y = random.uniform(0.35, 0.55)
    return Layout(
        walls=tuple(walls),
        ramp=ramp,
        start_x=LANE / 2,
        start_y=start_y if start_south else family.height - start_y,
        start_yaw=np.pi / 2 if start_south else -np.pi / 2,
    )


def _lines(first: float, last: float, cells: int, random: Generator) -> list[float]:
    """Coordinates [m] of the lines around so many cells."""
    lines = np.linspace(first, last, cells + 1)
    lines[1:-1] += random.uniform(-JITTER, JITTER, cells - 1)
    return [float(line) for line in lines]


def _cells(
    columns: int, rows: int, random: Generator
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which edges carry a wall: (columns - 1, rows) between columns, (rows - 1, columns) else.

    A depth-first walk opens the edges of a random spanning tree, so all cells are connected.
    """
    between_columns = np.ones((columns - 1, rows), bool)
    between_rows = np.ones((rows - 1, columns), bool)
    first = (int(random.integers(columns)), int(random.integers(rows)))
    visited, path = {first}, [first]
    while path:
        column, row = path[-1]
        around = [(column + 1, row), (column - 1, row), (column, row + 1), (column, row - 1)]
        steps = [
            cell
            for cell in around
            if 0 <= cell[0] < columns and 0 <= cell[1] < rows and cell not in visited
        ]
        if not steps:
            path.pop()
            continue
        step = steps[int(random.integers(len(steps)))]
        if step[1] == row:
            between_columns[min(column, step[0]), row] = False
        else:
            between_rows[min(row, step[1]), column] = False
        visited.add(step)
        path.append(step)
    between_columns &= random.random(between_columns.shape) >= OPENED
    between_rows &= random.random(between_rows.shape) >= OPENED
    return between_columns, between_rows


def _lane_wall(rows: int, start_south: bool, random: Generator) -> NDArray[np.bool_]:
    """(rows,): the wall beside the start, of variable length."""
    length = int(random.integers(1, rows))
    row = np.arange(rows)
    return row < length if start_south else row >= rows - length


def _strip_wall(ys: list[float], ramp: Ramp | None, random: Generator) -> NDArray[np.bool_]:
    """(rows,): closed but for some gaps, none of them beside the ramp."""
    last = np.inf if ramp is None else ramp.y - APPROACH
    candidates = np.flatnonzero(np.array(ys[1:]) <= last)
    gaps = random.choice(candidates, int(random.integers(1, min(3, len(candidates)) + 1)), False)
    return ~np.isin(np.arange(len(ys) - 1), gaps)


def _ramp(family: Family) -> Ramp:
    shape = Ramp(0.0, 0.0, 0.0, "")
    foot = family.height - RAMP_CLEARANCE - shape.length
    x = family.width - RAMP_CLEARANCE - shape.width / 2
    return Ramp(x, foot, np.pi / 2, "north-east")


def _outline(family: Family) -> list[tuple[float, float, float, float]]:
    width, height = family.width, family.height
    return [
        (0.0, 0.0, width, 0.0),
        (width, 0.0, width, height),
        (width, height, 0.0, height),
        (0.0, height, 0.0, 0.0),
    ]


def _stretches(edges: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and end of each run of edges that carry a wall: one panel instead of many."""
    changes = np.flatnonzero(np.diff(np.concatenate(([False], edges, [False])).astype(int)))
    return [(int(first), int(end)) for first, end in changes.reshape(-1, 2)]
