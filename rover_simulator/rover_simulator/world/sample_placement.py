"""Where a world's samples lie: by the walls, some of them just off the map."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray
from scipy import ndimage

from rover_common.geometry import Pose
from rover_simulator.world.distances import depth_of
from rover_simulator.world.wall_profile import MAP_MARGIN

SAMPLES = 6
# Samples of the original stand at the floor's height at the base of walls; further out than this
# the ground would bury them.
BEYOND_FLOOR = 0.3  # [m]
DEPTH = 1.5  # [m] inside the map
FROM_START = 12.0  # [m]
APART = 10.0  # [m]
CELLS = 8  # per metre, in which distances from the map are measured


def place_samples(
    navigable: NDArray[np.bool_], start: Pose, random: Generator
) -> NDArray[np.float64]:
    """Positions (6, 2) [m] near the walls, away from the start and from each other."""
    inside = np.kron(ndimage.binary_fill_holes(navigable), np.ones((CELLS, CELLS), bool))
    depth = depth_of(inside) / CELLS
    beyond = depth_of(~inside) / CELLS
    near_wall = (inside & (depth <= DEPTH)) | (~inside & (beyond <= MAP_MARGIN + BEYOND_FLOOR))
    near_wall &= _away_from_boulders(navigable, inside)
    points = (np.argwhere(near_wall)[:, ::-1] + 0.5) / CELLS
    points = points[np.hypot(points[:, 0] - start.x, points[:, 1] - start.y) > FROM_START]
    chosen: list[NDArray[np.float64]] = []
    for index in random.permutation(len(points)):
        point = points[index]
        if all(np.hypot(*(point - other)) > APART for other in chosen):
            chosen.append(point)
        if len(chosen) == SAMPLES:
            break
    return np.array(chosen, float).reshape(-1, 2)


def _away_from_boulders(
    navigable: NDArray[np.bool_], inside: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Points that leave clearance for the rover between them and a rock in the open."""
    holes = np.kron(~navigable, np.ones((CELLS, CELLS), bool)) & inside
    if not holes.any():
        return np.ones_like(inside)
    return np.asarray(depth_of(~holes) / CELLS > 2.5)
