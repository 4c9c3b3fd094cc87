"""The thermal sensors: what 8 x 8 pixels see of warm patches on walls."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from burger_simulator.model.physics import Physics
from burger_simulator.world.maze import WALL_THICKNESS, HeatSource, Maze
from rover_common.burger import BURGER

SAMPLE = 0.05  # [s] between two looks of the pixels
TIME_CONSTANT = 0.1  # [s] of a pixel
SUBRAYS = 3  # per pixel, in both directions
NOISE, NOISE_SLOW = 0.16, 0.05  # [K] at 10 frames a second and at 1
STEP = 0.25  # [K] of a reading
LIMITS = (0.0, 80.0)  # [C]
PATCH = 4.0  # sigmas, beyond which a patch is not felt
FAINT = 0.01  # [K] less than that counts as nothing
MOUNTING = np.array([0.0, 0.0, BURGER.thermal_z])  # [m] in base_footprint

Array = NDArray[np.float64]


class ThermalSensor:
    """Row 0 looks up, column 0 to the left, unless it is mounted mirrored."""

    def __init__(
        self, physics: Physics, maze: Maze, yaw: float, offset: float, flip: str, slow: bool,
        random: Generator,
    ) -> None:  # fmt: skip
        """yaw [rad], left positive; offset [K]; flip: none, rows, columns or both."""
        self._physics, self._random = physics, random
        self._air, self._faces = maze.air, warm_faces(maze.sources)
        self._axis = np.array([math.cos(yaw), math.sin(yaw), 0.0])
        self._directions = ray_directions(yaw)
        self._offset, self._flip = offset, flip
        self._noise = NOISE_SLOW if slow else NOISE
        self._celsius: Array | None = None

    def look(self) -> None:
        """Once in each SAMPLE: the pixels follow what they see with their time constant."""
        seen = self._seen()
        if self._celsius is None:
            self._celsius = seen
        # Of the discrete filters of first order, this one lags by the time constant.
        self._celsius += SAMPLE / (SAMPLE + TIME_CONSTANT) * (seen - self._celsius)

    def frame(self) -> NDArray[np.float32]:
        """(8, 8) [C] as the device reads it, after at least one look."""
        assert self._celsius is not None
        noise = self._noise * self._random.standard_normal(self._celsius.shape)
        read = np.clip(self._celsius + self._offset + noise, *LIMITS)
        frame = (np.round(read / STEP) * STEP).astype(np.float32)
        if self._flip in ("rows", "both"):
            frame = frame[::-1]
        if self._flip in ("columns", "both"):
            frame = frame[:, ::-1]
        return np.ascontiguousarray(frame)

    def _seen(self) -> Array:
        """(8, 8) [C] means of the surface temperatures that each pixel's rays hit.

        Only rays towards a warm patch are cast, to know whether a wall is before it.
        """
        rotation = self._physics.rotation
        origin = self._physics.position + rotation @ MOUNTING
        directions = self._directions @ rotation.T
        axis = rotation @ self._axis
        celsius = np.full(len(directions), self._air)
        for face in self._faces:
            if axis @ (np.array([face.x, face.y, face.height]) - origin) < -PATCH * face.sigma:
                continue  # all of it is behind the sensor
            if (towards := _towards(face, origin, directions)) is None:
                continue
            rays, distances, excess = towards
            free = self._physics.cast(origin, directions[rays], float(distances.max()) + 1.0)
            celsius[rays] += np.where(free > distances - WALL_THICKNESS / 2, excess, 0.0)
        pixels = BURGER.thermal_pixels
        return celsius.reshape(pixels, pixels, -1).mean(axis=2)


def warm_faces(sources: Sequence[HeatSource]) -> tuple[HeatSource, ...]:
    """Each with one warm face: a source with two becomes two."""
    faces = []
    for source in sources:
        faces.append(source)
        if source.both_faces:
            faces.append(
                replace(
                    source,
                    x=source.x - WALL_THICKNESS * math.cos(source.normal),
                    y=source.y - WALL_THICKNESS * math.sin(source.normal),
                    normal=source.normal + math.pi,
                )
            )
    return tuple(faces)


def ray_directions(yaw: float) -> Array:
    """(8 * 8 * 9, 3) in base_footprint, pixel by pixel, row by row."""
    pixels = BURGER.thermal_pixels
    fine = pixels * SUBRAYS
    angles = (0.5 - (np.arange(fine) + 0.5) / fine) * BURGER.thermal_field
    elevation, azimuth = np.meshgrid(angles, angles, indexing="ij")
    vectors = np.stack(
        [
            np.cos(elevation) * np.cos(yaw + azimuth),
            np.cos(elevation) * np.sin(yaw + azimuth),
            np.sin(elevation),
        ],
        axis=-1,
    )
    by_pixel = vectors.reshape(pixels, SUBRAYS, pixels, SUBRAYS, 3).swapaxes(1, 2)
    return np.ascontiguousarray(by_pixel.reshape(-1, 3))


def _towards(
    face: HeatSource, origin: Array, directions: Array
) -> tuple[NDArray[np.intp], Array, Array] | None:
    """Rays that point at the patch, how far it is [m] and how warm there [K]; None for none."""
    cos, sin = math.cos(face.normal), math.sin(face.normal)
    dx, dy = origin[0] - face.x, origin[1] - face.y
    before = cos * dx + sin * dy
    if before <= 0.0:
        return None
    towards = -cos * directions[:, 0] - sin * directions[:, 1]
    rays = np.flatnonzero(towards > 1e-3)
    distances = before / towards[rays]
    along = (
        cos * dy - sin * dx + distances * (cos * directions[rays, 1] - sin * directions[rays, 0])
    )
    up = origin[2] - face.height + distances * directions[rays, 2]
    excess = face.excess * np.exp(-(along**2 + up**2) / (2.0 * face.sigma**2))
    warm = excess > FAINT
    return (rays[warm], distances[warm], excess[warm]) if warm.any() else None
