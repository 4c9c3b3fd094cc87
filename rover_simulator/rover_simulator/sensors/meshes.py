"""Triangle meshes, and what rays hit of them, by Embree."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
from numpy.typing import NDArray

SKY = -1  # the number of what is hit where nothing is
SAMPLE_RADIUS, SAMPLE_HEIGHT = 0.08, 0.13  # [m]

Mesh = tuple[NDArray[np.float32], NDArray[np.int32]]  # vertices (n, 3) [m] and triangles (m, 3)


@dataclass(frozen=True)
class Hits:
    """What each of n rays hits first."""

    number: NDArray[np.int32]  # (n,) of the mesh, or SKY
    distance: NDArray[np.float32]  # (n,) [m] for unit rays; far beyond the world for SKY
    normal: NDArray[np.float32]  # (n, 3) of the triangle, of any length

    def put(self, index: NDArray[np.intp], other: Hits) -> None:
        """Replace the hits of the rays with these indices (m,)."""
        self.number[index] = other.number
        self.distance[index] = other.distance
        self.normal[index] = other.normal

    def take(self, index: NDArray[np.intp]) -> Hits:
        return Hits(self.number[index], self.distance[index], self.normal[index])


class MeshScene:
    """Some meshes, numbered in their order from `first` on."""

    def __init__(self, meshes: list[Mesh], first: int) -> None:
        self._first = first
        self._scene = rtcore_scene.EmbreeScene()
        self._meshes = [TriangleMesh(self._scene, *mesh) for mesh in meshes]

    def trace(self, origins: NDArray, rays: NDArray) -> Hits:
        """The first hits of rays (n, 3) from points (n, 3)."""
        hits = self._scene.run(
            np.ascontiguousarray(origins, np.float32),
            np.ascontiguousarray(rays, np.float32),
            output=1,
        )
        number = hits["geomID"]
        if self._first:
            number[number != SKY] += self._first
        return Hits(number, hits["tfar"], hits["Ng"])


def sample_mesh(x: float, y: float) -> Mesh:
    """A rock of eight sides; its base is at the floor's height, also where the ground is higher."""
    angle = np.arange(8) * math.pi / 4
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1) * SAMPLE_RADIUS
    low = np.column_stack([ring + np.array([x, y]), np.zeros(8)])
    shoulder = np.full(8, 0.7 * SAMPLE_HEIGHT)
    high = np.column_stack([0.75 * ring + np.array([x, y]), shoulder])
    top = np.array([[x, y, SAMPLE_HEIGHT]])
    i, j = np.arange(8), (np.arange(8) + 1) % 8
    sides = np.concatenate(
        [
            np.stack([i, j, i + 8], axis=1),
            np.stack([j, j + 8, i + 8], axis=1),
            np.stack([i + 8, j + 8, np.full(8, 16)], axis=1),
        ]
    )
    return np.concatenate([low, high, top]).astype(np.float32), sides.astype(np.int32)
