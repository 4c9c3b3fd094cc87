"""The geometry of a world, and what the camera's rays hit in it."""

from __future__ import annotations

import math

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
from numpy.typing import NDArray

from rover_simulator.world import boulders
from rover_simulator.world.terrain import SPACING, Terrain
from rover_simulator.world.world import World

BEHIND = 1e-3  # [m] past ground that is hit from behind, where its ray is continued
SAMPLE_RADIUS, SAMPLE_HEIGHT = 0.08, 0.13  # [m]
SKY, GROUND = -1, 0  # numbers of what is hit; samples follow, then boulders

Mesh = tuple[NDArray[np.float32], NDArray[np.int32]]  # vertices (n, 3) [m] and triangles (m, 3)


class Scene:
    """Terrain, samples and boulders as meshes, each with a number: 0, 1 to n, n + 1 onwards."""

    def __init__(self, world: World, terrain: Terrain) -> None:
        self._terrain = terrain
        self._samples = world.samples.copy()
        self._meshes = [terrain.triangles()]
        self._meshes += [_sample_mesh(float(x), float(y)) for x, y in world.samples]
        self._meshes += [boulders.mesh(boulder) for boulder in world.boulders]
        boulders_at = [(boulder.x, boulder.y, boulder.radius) for boulder in world.boulders]
        samples_at = [(float(x), float(y), SAMPLE_RADIUS) for x, y in world.samples]
        self._standing = np.array(boulders_at + samples_at).reshape(-1, 3)
        self._build()

    @property
    def sample_count(self) -> int:
        """Hidden ones included."""
        return len(self._samples)

    def hide_sample(self, x: float, y: float) -> bool:
        """Whether a sample was at this place [m], which now is gone; takes half a second."""
        there = np.flatnonzero((self._samples == (x, y)).all(axis=1))
        for index in there:
            self._samples[index] = np.nan
            vertices, triangles = self._meshes[index + 1]
            # Below all ground, so that the others keep their numbers.
            self._meshes[index + 1] = (vertices - np.array([0, 0, 1000], np.float32), triangles)
            self._build()
        return len(there) > 0

    def cast(
        self, origin: NDArray[np.float64], rays: NDArray[np.float32], level: NDArray[np.float32]
    ) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
        """Numbers (n,) of what unit rays (3, n) hit, and its distances (n,) [m], 0 for the sky.

        `level` (n,) is the length of their horizontal parts. Rays that hit the bare floor around
        the camera need no search.
        """
        reach = self._bare_radius(origin)
        bare = level * np.float32(origin[2]) < -rays[2] * np.float32(reach)
        bare &= reach > 0.0
        hit = np.full(rays.shape[1], GROUND, np.int32)
        distance = np.zeros(rays.shape[1], np.float32)
        found, searched = np.flatnonzero(bare), np.flatnonzero(~bare)
        distance[found] = -origin[2] / rays[2].take(found)
        if len(searched):
            there = np.stack([axis.take(searched) for axis in rays], axis=1)
            first = self.trace(np.broadcast_to(origin, there.shape), there)
            if self._terrain.height_at_point(*origin[:2].tolist()) > origin[2]:
                self._look_out_of_the_ground(origin, there, first)
            hit[searched] = first["geomID"]
            distance[searched] = np.where(first["geomID"] != SKY, first["tfar"], 0.0)
        return hit, distance

    def trace(self, origins: NDArray, directions: NDArray) -> dict[str, NDArray]:
        """Embree's first hits of rays (n, 3): geomID (n,), tfar (n,), Ng (n, 3) among others."""
        hits: dict[str, NDArray] = self._scene.run(
            np.ascontiguousarray(origins, np.float32),
            np.ascontiguousarray(directions, np.float32),
            output=1,
        )
        return hits

    def _build(self) -> None:
        self._scene = rtcore_scene.EmbreeScene()
        self._geometries = [TriangleMesh(self._scene, *mesh) for mesh in self._meshes]

    def _look_out_of_the_ground(
        self, origin: NDArray[np.float64], rays: NDArray[np.float32], hit: dict[str, NDArray]
    ) -> None:
        """Correct the hits of unit rays (n, 3) that start inside of a wall.

        Ground has one side: from behind it is not there, and nothing is below it but the sky.
        """
        ground = hit["geomID"] == GROUND
        behind = ground & (np.einsum("ij,ij->i", hit["Ng"], rays) > 0.0)
        hit["geomID"][ground & ~behind] = SKY  # the flat floor, which goes on below the walls
        through = np.flatnonzero(behind)
        if not len(through):
            return
        onward = rays[through]
        passed = hit["tfar"][through] + BEHIND
        beyond = self.trace(origin + onward * passed[:, None], onward)
        hit["geomID"][through] = beyond["geomID"]
        hit["tfar"][through] = beyond["tfar"] + passed

    def _bare_radius(self, origin: NDArray[np.float64]) -> float:
        """Around a point, the radius [m] of flat floor on which nothing stands; 0 for none."""
        if origin[2] <= 0.0:  # the nose is in the ground
            return 0.0
        x, y = origin[:1], origin[1:2]
        radius = -float(self._terrain.outside_at(x, y)[0]) - 2 * SPACING
        if len(self._standing):
            there = self._standing
            away = np.hypot(there[:, 0] - x, there[:, 1] - y) - there[:, 2]
            radius = min(radius, float(np.min(away)))
        return max(0.0, radius)


def _sample_mesh(x: float, y: float) -> Mesh:
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
