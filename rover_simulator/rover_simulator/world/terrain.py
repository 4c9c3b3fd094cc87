"""The ground of a world as a height field, from its map and the measured wall profile."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from rover_simulator.world.boulders import boulder_cells
from rover_simulator.world.distances import depth_of
from rover_simulator.world.wall_profile import MAP_MARGIN, height_at, spread_at
from rover_simulator.world.world import World

SPACING = 0.390625  # [m] between heights, 513 of them over 200 m, as in the original
COUNT = 513
FINE = 8  # distances are measured on a grid of 1/8 m
# The relief: shares of noise of these widths [m]. Skylines of the original are round over metres.
RELIEF_WIDTHS, RELIEF_SHARES = (1.5, 5.0, 15.0), (0.15, 0.5, 1.0)
# [m] The original's samples stand at the floor's height, also at the base of a wall, but their
# places were chosen so that they are visible: only 4 of 33 are on ground that is higher than this.
SAMPLE_GROUND = 0.08
SAMPLE_REACH = (SPACING * math.sqrt(2), 2.0)  # [m] around a sample: as low, and lowered at all
NO_SAMPLES = np.empty((0, 2))


@dataclass(frozen=True, eq=False)
class Terrain:
    heights: NDArray[np.float32]  # (513, 513) [m], [y, x]
    outside: NDArray[np.float32]  # (1600, 1600) [m] from the flat floor's edge, negative inside

    @classmethod
    def of(
        cls,
        navigable: NDArray[np.bool_],
        seed: int = 0,
        relief: NDArray[np.floating] | None = None,
        samples: NDArray[np.floating] = NO_SAMPLES,
    ) -> Terrain:
        """Build it from the median profile of walls. Boulders stand on its floor.

        relief: factors (513, 513) of the heights; without it they are drawn from the seed, with
        the spread that was measured. samples: points (n, 2) [m], around which the ground is low.
        """
        floor = _floor(navigable | boulder_cells(navigable))
        outside = np.asarray(np.where(floor, -depth_of(floor), depth_of(~floor)) / FINE, np.float32)
        at = np.arange(COUNT) * SPACING
        distance = _sample(outside, *np.meshgrid(at, at))
        if relief is None:
            relief = np.exp(spread_at(distance) * _noise(seed))
        heights = height_at(distance) * relief
        for x, y in samples:
            heights = _lowered(heights, float(x), float(y))
        return cls(heights.astype(np.float32), outside)

    def outside_at(self, x: NDArray, y: NDArray) -> NDArray[np.float32]:
        """Distance [m] outside of the flat floor at points [m]."""
        return _sample(self.outside, x, y)

    def height_at(self, x: NDArray, y: NDArray) -> NDArray[np.float32]:
        """Height [m] of the ground at points [m]."""
        at = [np.asarray(y) / SPACING, np.asarray(x) / SPACING]
        return ndimage.map_coordinates(self.heights, at, order=1, mode="nearest")

    def height_at_point(self, x: float, y: float) -> float:
        """What `height_at` gives for one point [m], without the cost of arrays."""
        return self.surface_at(x, y)[0]

    def surface_at(self, x: float, y: float) -> tuple[float, float, float]:
        """Height [m] of the ground at a point [m], and its rise per metre to east and north."""
        row, col = min(max(y / SPACING, 0.0), COUNT - 1.0), min(max(x / SPACING, 0.0), COUNT - 1.0)
        top, left = min(int(row), COUNT - 2), min(int(col), COUNT - 2)
        upper, lower = self._rows[top], self._rows[top + 1]
        a, b, c, d = upper[left], upper[left + 1], lower[left], lower[left + 1]
        if a == b == c == d:  # the floor
            return a, 0.0, 0.0
        down, right = row - top, col - left
        up, back = 1.0 - down, 1.0 - right
        height = _single(a * up * back + b * up * right + c * down * back + d * down * right)
        east = ((b - a) * up + (d - c) * down) / SPACING
        north = ((c - a) * back + (d - b) * right) / SPACING
        return height, east, north

    @cached_property
    def _rows(self) -> list[list[float]]:
        """The heights as plain numbers."""
        rows: list[list[float]] = self.heights.tolist()
        return rows

    def triangles(self) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
        """Vertices (n, 3) [m] and triangles (m, 3) of the height field, its flat parts in two."""
        at = (np.arange(COUNT) * SPACING).astype(np.float32)
        x, y = np.meshgrid(at, at)
        vertices = np.stack([x, y, self.heights], axis=-1).reshape(-1, 3)
        corner = (np.arange(COUNT - 1)[:, None] * COUNT + np.arange(COUNT - 1)).ravel()
        lower = np.stack([corner, corner + 1, corner + COUNT], axis=1)
        upper = np.stack([corner + 1, corner + COUNT + 1, corner + COUNT], axis=1)
        triangles = np.concatenate([lower, upper])
        rises = (self.heights.ravel()[triangles] > 0.0).any(axis=1)
        corners = np.array([0, COUNT - 1, COUNT * COUNT - 1, COUNT * (COUNT - 1)])
        floor = vertices[corners] * np.array([1, 1, 0], np.float32)
        halves = len(vertices) + np.array([[0, 1, 2], [0, 2, 3]])
        return (
            np.concatenate([vertices, floor]),
            np.concatenate([triangles[rises], halves]).astype(np.int32),
        )


@lru_cache(maxsize=1)  # of the world that is simulated again and again
def terrain_of(world: World, seed: int) -> Terrain:
    """The terrain of a world with its samples; the seed draws the relief."""
    return Terrain.of(world.navigable, seed, samples=world.samples)


def _lowered(heights: NDArray[np.float64], x: float, y: float) -> NDArray[np.float64]:
    """The heights, no higher than a sample's ground at a point [m] and less so away from it."""
    at = np.arange(COUNT) * SPACING
    away = np.hypot(*np.meshgrid(at - x, at - y))
    near, far = SAMPLE_REACH
    share = np.clip((far - away) / (far - near), 0.0, 1.0)
    return heights + share * (np.minimum(heights, SAMPLE_GROUND) - heights)


def _noise(seed: int) -> NDArray[np.float64]:
    """Smooth noise (513, 513) of standard deviation 1."""
    white = np.random.default_rng(seed).standard_normal((COUNT, COUNT))
    total = np.zeros((COUNT, COUNT))
    for width, share in zip(RELIEF_WIDTHS, RELIEF_SHARES, strict=True):
        smooth = ndimage.gaussian_filter(white, width / SPACING, mode="wrap", truncate=3.0)
        total += share * smooth / smooth.std()
    return total / total.std()


def _floor(navigable: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The flat floor on the fine grid: the cells and the margin around them, with rounded edges."""
    cells = np.kron(navigable, np.ones((FINE, FINE), bool))
    grown = (depth_of(~cells) / FINE < MAP_MARGIN + 0.3).astype(np.float32)
    return ndimage.gaussian_filter(grown, 0.4 * FINE) > 0.5 + 0.2


def _sample(grid: NDArray[np.float32], x: NDArray, y: NDArray) -> NDArray[np.float32]:
    """Bilinear value of the fine grid, whose cell centres lie at (i + 0.5) / FINE [m]."""
    at = [np.asarray(y) * FINE - 0.5, np.asarray(x) * FINE - 0.5]
    return ndimage.map_coordinates(grid, at, order=1, mode="nearest")


def _single(value: float) -> float:
    """Rounded to single precision, that of the heights."""
    return float(np.float32(value))
