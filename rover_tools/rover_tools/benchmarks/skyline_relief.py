"""Relief of the original's walls, measured on its recorded skylines.

The map tells where walls stand, not how high each of them is. Recorded frames do: a ray that sees
the sky passes above all ground along it, and the lowest one of an image column touches the ground
somewhere, most likely where the ground stands highest against it. From many columns the factors of
the median profile follow as in tomography: ground above a ray is lowered to it, a column that does
not reach its ray is raised at its highest point, corrections are averaged over a width that shrinks
from pass to pass. Nothing is known where no skyline was seen; there the factor stays near that of
its surroundings or 1. The relief lives in memory only; nothing of the recordings is kept.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from rover_common.camera import ORIGIN_HEIGHT, ROVER_CAMERA
from rover_common.geometry import Pose, rotation_matrix
from rover_simulator.world.terrain import COUNT, SPACING, Terrain

COLUMN_STEP = 2  # image columns between two that are used
# [m] points along a ray: nothing nearer than 1 m shows its top, nothing beyond 130 m was seen.
RANGES = np.concatenate([np.arange(1, 40, 0.5), np.arange(40, 130, 1.0)]).astype(np.float32)
WIDTHS = (12.0, 8.0, 5.0, 3.0, 2.0, 1.5)  # [cells of 0.39 m] over which corrections are averaged
PASSES = 4  # at each width
RATE = 0.8  # share of a correction that is made
LOWEST = 0.1  # [m] ground below is floor and keeps its height
TOUCH = 0.02  # a silhouette within this tangent of its ray confirms the ground where it is


@dataclass(frozen=True)
class Skyline:
    """The lowest rays of the sky, or the highest of the image where a column shows no sky."""

    origins: NDArray[np.float32]  # (n, 3) [m] the camera
    directions: NDArray[np.float32]  # (n, 3) of horizontal length 1
    open: NDArray[np.bool_]  # (n,) the sky is seen above


def read_skyline(frames: Iterable[tuple[Pose, NDArray[np.bool_]]]) -> Skyline:
    """From poses and masks (160, 320) of the sky."""
    columns = np.arange(0, ROVER_CAMERA.width, COLUMN_STEP)
    aside = (ROVER_CAMERA.center_u - columns - 0.5) / ROVER_CAMERA.focal
    origins, directions, is_open = [], [], []
    for pose, sky in frames:
        edge = _lower_edge(sky[:, columns])
        rise = (ROVER_CAMERA.center_v - edge) / ROVER_CAMERA.focal
        rotation = rotation_matrix(pose)
        rays = np.stack([np.ones(len(columns)), aside, rise], axis=1) @ rotation.T
        camera = rotation @ np.array([ROVER_CAMERA.forward, 0.0, ROVER_CAMERA.up])
        origin = np.array([pose.x, pose.y, ORIGIN_HEIGHT]) + camera
        origins.append(np.broadcast_to(origin, rays.shape))
        directions.append(rays / np.hypot(rays[:, 0], rays[:, 1])[:, None])
        is_open.append(edge > 0)
    return Skyline(
        np.concatenate(origins).astype(np.float32),
        np.concatenate(directions).astype(np.float32),
        np.concatenate(is_open),
    )


def carve(median: Terrain, skyline: Skyline) -> NDArray[np.float64]:
    """Factors (513, 513) of the heights of a terrain of the median profile."""
    base = np.maximum(median.heights, 0.02).ravel()
    cells, heights_of_rays = _along(skyline)
    logarithm = np.zeros((COUNT, COUNT))
    for width in WIDTHS:
        for _ in range(PASSES):
            heights = (base * np.exp(logarithm.ravel())).astype(np.float32)
            correction = _correction(heights, cells, heights_of_rays, skyline)
            logarithm += RATE * np.clip(_averaged(*correction, width), -1.0, 1.0)
    return np.exp(logarithm)


def _lower_edge(sky: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Row (cols,) below the sky: the split of each column that contradicts fewest pixels."""
    rows = np.arange(1, len(sky) + 1)[:, None]
    gain = np.cumsum(sky, axis=0) - 0.5 * rows
    return np.where(gain.max(axis=0) > 0, gain.argmax(axis=0) + 1, 0)


def _along(skyline: Skyline) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """Cells (n, ranges) below the points of each ray, and the points' heights [m].

    Points outside of the world lie over its corner cell, which is low.
    """
    x, y, z = (
        skyline.origins[:, axis, None] + skyline.directions[:, axis, None] * RANGES
        for axis in range(3)
    )
    col, row = np.rint(x / SPACING).astype(np.int32), np.rint(y / SPACING).astype(np.int32)
    inside = (col >= 0) & (col < COUNT) & (row >= 0) & (row < COUNT)
    return np.where(inside, row * COUNT + col, 0), z


def _correction(
    heights: NDArray[np.float32],
    cells: NDArray[np.int32],
    rays: NDArray[np.float32],
    skyline: Skyline,
) -> tuple[NDArray, NDArray]:
    """Sums (513, 513) of the corrections of the heights' logarithm, and how many there are."""
    ground = heights[cells]
    ground[cells == 0] = 0.0
    tangent = (ground - skyline.origins[:, 2:3]) / RANGES
    index = np.arange(len(cells))
    at = tangent.argmax(axis=1)
    top, wanted = tangent[index, at], skyline.directions[:, 2]
    over = (ground > rays) & skyline.open[:, None] & (ground > LOWEST)
    under = (top < wanted) & (rays[index, at] > LOWEST) & (ground[index, at] > 5 * LOWEST)
    touching = skyline.open & ~under & (np.abs(top - wanted) < TOUCH)
    lowered = np.log(np.maximum(rays[over], 0.02) / ground[over])
    raised = np.log(rays[index, at][under] / ground[index, at][under])
    where = np.concatenate([cells[over], cells[index, at][under], cells[index, at][touching]])
    change = np.concatenate([lowered, raised, np.zeros(np.count_nonzero(touching))])
    size = COUNT * COUNT
    total = np.bincount(where, change, minlength=size).reshape(COUNT, COUNT)
    count = np.bincount(where, minlength=size).reshape(COUNT, COUNT)
    return total, count.astype(float)


def _averaged(
    total: NDArray[np.float64], count: NDArray[np.float64], width: float
) -> NDArray[np.float64]:
    """Corrections spread over this width [cells]; every corrected cell counts once."""
    mean = total / np.maximum(count, 1.0)
    weight = ndimage.gaussian_filter((count > 0).astype(float), width)
    spread = ndimage.gaussian_filter(mean, width) / (weight + 0.02 * weight.max() + 1e-6)
    return np.asarray(spread, np.float64)
