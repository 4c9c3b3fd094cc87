"""Worlds: canyons drawn from a seed, and maps from an image file.

A drawn canyon has an open centre, winding arms with dead ends, loops, and small rocks in the open.
"""

from __future__ import annotations

import math
from functools import lru_cache
from pathlib import Path

import cv2
import numpy as np
from numpy.random import Generator, default_rng
from numpy.typing import NDArray
from scipy import ndimage

from rover_common.geometry import Pose
from rover_common.grid import WORLD
from rover_common.ground_truth import load_truth
from rover_simulator.world.sample_placement import place_samples
from rover_simulator.world.world import World

SCALE = 4  # pixels per metre while drawing
BORDER = 15.0  # [m] kept free of canyon at the world's edge
ARMS = 4
PILLAR_SHARE = 0.5  # of the worlds have a chamber with a pillar: a loop to drive around
BOULDERS = 5  # holes of one or two cells
BOULDER_DEPTH = 2.5  # [m] from the walls at least, so that it can be passed on both sides
BOULDER_FROM_START = 4.0  # [m]

Point = NDArray[np.float64]
Canvas = NDArray[np.uint8]


@lru_cache(maxsize=1)  # of the one that is simulated again: what is painted of it is kept as well
def generate_world(seed: int, size: float = 1.0) -> World:
    """The canyon of a seed; `size` scales the length of its arms, 1 for that of the original.

    Its arrays cannot be written to: whoever asks again gets the same world.
    """
    random = default_rng(seed)
    center = random.uniform(85, 115, 2)
    canvas = np.zeros((200 * SCALE, 200 * SCALE), np.uint8)
    _chamber(canvas, center, random.uniform(6, 9), random)
    heading = random.uniform(0, 2 * math.pi)
    ends: list[Point] = []
    for arm in range(ARMS):
        angle = heading + arm * 2 * math.pi / ARMS + random.normal(0, 0.25)
        end, angle = _corridor(canvas, center, angle, size * random.uniform(50, 85), random)
        _chamber(canvas, end, random.uniform(3, 6), random)
        aside = angle + random.choice((-1, 1)) * random.uniform(0.9, 1.4)
        _corridor(canvas, end, aside, size * random.uniform(8, 16), random)
        ends.append(end)
    if random.random() < PILLAR_SHARE:
        _pillared_chamber(canvas, ends[int(random.integers(ARMS))], random)
    navigable = _to_cells(canvas, center)
    _place_boulders(navigable, center, random)
    start = Pose(float(center[0]), float(center[1]), float(random.uniform(-math.pi, math.pi)))
    samples = place_samples(navigable, start, random)
    for array in (navigable, samples):
        array.setflags(write=False)
    return World(f"seed-{seed}", navigable, samples, start)


def world_of_map(path: Path, seed: int) -> World:
    """The canyon of a map of 200 x 200 pixels, unflipped; raises TruthError for a bad one."""
    return world_on_ground(load_truth(path), path.stem, seed)


def world_on_ground(truth: NDArray[np.bool_], name: str, seed: int) -> World:
    """A canyon of these navigable cells (200, 200); the seed draws samples and the start's yaw.

    The rover starts where it does in the original, or, where that is no ground, in the middle of
    the ground nearest to the map's middle.
    """
    random = default_rng(seed)
    x, y = WORLD.start_x, WORLD.start_y
    row, col = int(y), int(x)
    if not truth[row, col]:
        depth = ndimage.distance_transform_edt(truth)
        rows, cols = np.nonzero(depth >= 0.7 * depth.max())
        nearest = int(np.argmin(np.hypot(rows - 100, cols - 100)))
        row, col = rows[nearest], cols[nearest]
        x, y = col + 0.5, row + 0.5
    labels, _ = ndimage.label(truth)
    start = Pose(float(x), float(y), float(random.uniform(-math.pi, math.pi)))
    samples = place_samples(labels == labels[row, col], start, random)
    return World(f"{name}-{seed}", truth, samples, start)


def _corridor(
    canvas: Canvas, start: Point, angle: float, length: float, random: Generator
) -> tuple[Point, float]:
    """Draw a winding corridor; returns its end [m] and its last direction [rad]."""
    point = np.array(start, float)
    width = random.uniform(4.0, 7.0)
    bend = 0.0
    for _ in range(max(1, round(length))):
        bend = 0.9 * bend + random.normal(0, 0.035)
        width = float(np.clip(width + random.normal(0, 0.35), 3.2, 10.0))
        angle += bend
        to_middle = math.atan2(100 - point[1], 100 - point[0])
        if np.any(point < BORDER) or np.any(point > 200 - BORDER):
            angle = to_middle
        point = point + np.array([math.cos(angle), math.sin(angle)])
        cv2.circle(canvas, _pixel(point), round(width / 2 * SCALE), 255, -1)
    return point, angle


def _chamber(canvas: Canvas, center: Point, radius: float, random: Generator) -> None:
    for _ in range(6):
        offset = random.normal(0, radius / 2.5, 2)
        cv2.circle(canvas, _pixel(center + offset), round(radius * 0.7 * SCALE), 255, -1)
    cv2.circle(canvas, _pixel(center), round(radius * 0.6 * SCALE), 255, -1)


def _pillared_chamber(canvas: Canvas, center: Point, random: Generator) -> None:
    radius = random.uniform(7.0, 9.0)
    cv2.circle(canvas, _pixel(center), round(radius * SCALE), 255, -1)
    cv2.circle(canvas, _pixel(center), round((radius - 4.5) * SCALE), 0, -1)


def _pixel(point: Point) -> tuple[int, int]:
    return round(float(point[0]) * SCALE), round(float(point[1]) * SCALE)


def _to_cells(canvas: Canvas, center: Point) -> NDArray[np.bool_]:
    """Navigable cells of 1 m: smooth outlines, one connected region."""
    smooth = cv2.GaussianBlur(canvas, (0, 0), 0.8 * SCALE)
    cells = smooth.reshape(200, SCALE, 200, SCALE).mean(axis=(1, 3)) > 127
    labels, _ = ndimage.label(cells)
    return np.asarray(labels == labels[int(center[1]), int(center[0])])


def _place_boulders(navigable: NDArray[np.bool_], center: Point, random: Generator) -> None:
    """Punch small holes into open ground: rocks that stand there."""
    for _ in range(BOULDERS):
        depth = ndimage.distance_transform_edt(navigable)
        rows, cols = np.nonzero(depth > BOULDER_DEPTH)
        far = np.hypot(cols + 0.5 - center[0], rows + 0.5 - center[1]) > BOULDER_FROM_START
        if not far.any():
            return
        index = random.choice(np.flatnonzero(far))
        row, col = rows[index], cols[index]
        navigable[row, col : col + 1 + int(random.integers(2))] = False
