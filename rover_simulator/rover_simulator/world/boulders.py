"""Small rocks that stand in the open and block the rover: the small holes of a world's map."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER

# In the original, holes of 1 to 5 cells are rocks, larger ones are walls with a floor around them.
LARGEST_HOLE = 6  # [cells of 1 m]
RADIUS = (0.35, 0.55)  # [m]
# [m] between the middles; beyond, no boulder touches the wheelbase, whose corners are 0.7 m away
OUT_OF_REACH = 1.5
HEIGHT = (0.3, 0.6)  # [m] tops of the rocks near the original's start: 0.06 to 0.59


@dataclass(frozen=True)
class Boulder:
    x: float  # [m] map frame, its middle on the ground
    y: float
    radius: float  # [m]
    height: float  # [m]


def boulder_cells(navigable: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Cells (200, 200) that are no ground, but not a wall either: they stand in the open."""
    holes, _ = ndimage.label(ndimage.binary_fill_holes(navigable) & ~navigable)
    sizes = np.bincount(holes.ravel())
    small = sizes <= LARGEST_HOLE
    small[0] = False  # what is no hole
    return np.asarray(small[holes])


def boulders_of(navigable: NDArray[np.bool_], seed: int) -> list[Boulder]:
    """One for each cell of a small hole; the seed decides its size."""
    random = np.random.default_rng(seed)
    return [
        Boulder(col + 0.5, row + 0.5, random.uniform(*RADIUS), random.uniform(*HEIGHT))
        for row, col in np.argwhere(boulder_cells(navigable))
    ]


def overlap(pose: Pose, boulders: list[Boulder]) -> float:
    """How deep [m] the rover's wheelbase reaches into a boulder, the deepest; 0 for none."""
    c, s = math.cos(pose.yaw), math.sin(pose.yaw)
    deepest = 0.0
    for boulder in boulders:
        dx, dy = boulder.x - pose.x, boulder.y - pose.y
        if abs(dx) > OUT_OF_REACH or abs(dy) > OUT_OF_REACH:
            continue
        ahead, aside = c * dx + s * dy, abs(c * dy - s * dx)
        beyond = math.hypot(
            max(0.0, ahead - ROVER.body_front, -ROVER.body_rear - ahead),
            max(0.0, aside - ROVER.body_half_width),
        )
        deepest = max(deepest, boulder.radius - beyond)
    return deepest


def mesh(boulder: Boulder) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """Vertices (n, 3) [m] and triangles (m, 3): a flattened dome of eight sides."""
    sides = 8
    angle = np.arange(sides) * 2 * math.pi / sides
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1) * boulder.radius
    rings = [(1.0, -0.05), (0.9, 0.5), (0.6, 0.85)]  # shares of its radius and of its height
    vertices = [
        np.column_stack([share * circle, np.full(sides, up * boulder.height)])
        for share, up in rings
    ]
    points = np.concatenate([*vertices, [[0.0, 0.0, boulder.height]]])
    points[:, :2] += (boulder.x, boulder.y)
    i, j = np.arange(sides), (np.arange(sides) + 1) % sides
    triangles = []
    for ring in range(len(rings) - 1):
        low, high = ring * sides, (ring + 1) * sides
        triangles += [
            np.stack([low + i, low + j, high + i], axis=1),
            np.stack([low + j, high + j, high + i], axis=1),
        ]
    last, top = (len(rings) - 1) * sides, len(points) - 1
    triangles.append(np.stack([last + i, last + j, np.full(sides, top)], axis=1))
    return points.astype(np.float32), np.concatenate(triangles).astype(np.int32)
