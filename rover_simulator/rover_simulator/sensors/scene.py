"""The geometry of a world, and what the camera's rays hit in it."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_simulator.sensors.meshes import SAMPLE_RADIUS, SKY, Hits, MeshScene, sample_mesh
from rover_simulator.world import boulders
from rover_simulator.world.terrain import SPACING, Terrain
from rover_simulator.world.world import World

GROUND = 0  # its number; those of the samples follow, then those of the boulders
BEHIND = 1e-3  # [m] past ground that is hit from behind, where its ray is continued
OUT_OF_SIGHT = np.array([0.0, 0.0, -1000.0], np.float32)  # [m] below all ground
# Of the image's columns: viewing directions to the left per ahead, in the order of the columns.
LEFT_PER_AHEAD = ROVER_CAMERA.rays()[0, :, 1]


class Scene:
    """The ground, and samples and boulders: objects that stand on it.

    The objects are a scene of their own. It is quick to build again without a sample that was
    lifted, and only rays in those columns of the image that show an object are traced in it.
    """

    def __init__(self, world: World, terrain: Terrain) -> None:
        self._terrain = terrain
        self._ground = _ground_of(terrain)
        self._samples = world.samples.copy()
        self._meshes = [sample_mesh(float(x), float(y)) for x, y in world.samples]
        self._meshes += [boulders.mesh(boulder) for boulder in world.boulders]
        samples_at = [(float(x), float(y), SAMPLE_RADIUS) for x, y in world.samples]
        boulders_at = [(boulder.x, boulder.y, boulder.radius) for boulder in world.boulders]
        self._occupied = np.array(samples_at + boulders_at).reshape(-1, 3)  # x, y, radius [m]
        self._build_objects()

    @property
    def sample_count(self) -> int:
        """Hidden ones included."""
        return len(self._samples)

    def hide_sample(self, x: float, y: float) -> bool:
        """Whether a sample was at this place [m], which now is gone."""
        there = np.flatnonzero((self._samples == (x, y)).all(axis=1))
        for index in there:
            self._samples[index] = np.nan
            vertices, triangles = self._meshes[index]
            self._meshes[index] = (vertices + OUT_OF_SIGHT, triangles)  # others keep their numbers
        if len(there):
            self._build_objects()
        return len(there) > 0

    def cast(
        self,
        origin: NDArray[np.float64],
        rotation: NDArray[np.float64],
        rays: NDArray[np.float32],
        level: NDArray[np.float32],
    ) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
        """Numbers (n,) of what is hit, SKY for nothing, and distances (n,) [m], 0 for the sky.

        The unit rays (3, n) are those of whole rows of the image, from a camera at `origin` [m]
        with this rotation (3, 3); `level` (n,) is the length of their horizontal parts. Rays that
        hit the bare floor around the camera need no search.
        """
        reach = self._bare_radius(origin)
        bare = level * np.float32(origin[2]) < -rays[2] * np.float32(reach)
        bare &= reach > 0.0
        number = np.full(rays.shape[1], GROUND, np.int32)
        distance = np.zeros(rays.shape[1], np.float32)
        found, searched = np.flatnonzero(bare), np.flatnonzero(~bare)
        distance[found] = -origin[2] / rays[2].take(found)
        if len(searched):
            there = np.stack([axis.take(searched) for axis in rays], axis=1)
            columns = self._columns_with_objects(origin, rotation)
            hits = self._trace(origin, there, columns[searched % len(columns)])
            if self._terrain.height_at_point(*origin[:2].tolist()) > origin[2]:
                self._look_out_of_the_ground(origin, there, hits)
            number[searched] = hits.number
            distance[searched] = np.where(hits.number != SKY, hits.distance, 0.0)
        return number, distance

    def is_blocked(
        self, points: NDArray[np.floating], direction: NDArray[np.floating]
    ) -> NDArray[np.bool_]:
        """Whether anything is hit from each of the points (n, 3) [m] in a direction (3,)."""
        rays = np.broadcast_to(direction, points.shape)
        return self._trace(points, rays, np.ones(len(points), bool)).number != SKY

    def _build_objects(self) -> None:
        self._objects = MeshScene(self._meshes, GROUND + 1)
        low = np.array([vertices.min(axis=0) for vertices, _ in self._meshes]).reshape(-1, 3)
        high = np.array([vertices.max(axis=0) for vertices, _ in self._meshes]).reshape(-1, 3)
        self._centers = 0.5 * (low + high)
        self._radii = 0.5 * np.linalg.norm(high - low, axis=1)

    def _trace(self, origins: NDArray, rays: NDArray, near_objects: NDArray[np.bool_]) -> Hits:
        """First hits of rays (n, 3) from a point (3,) or points (n, 3).

        `near_objects` (n,) is false for rays that cannot hit an object.
        """
        origins = np.broadcast_to(origins, rays.shape)
        hits = self._ground.trace(origins, rays)
        some = np.flatnonzero(near_objects)
        if len(some) and self._meshes:
            objects = self._objects.trace(origins[some], rays[some])
            nearer = np.flatnonzero(objects.distance < hits.distance[some])
            hits.put(some[nearer], objects.take(nearer))
        return hits

    def _columns_with_objects(
        self, origin: NDArray[np.float64], rotation: NDArray[np.float64]
    ) -> NDArray[np.bool_]:
        """Columns (width,) of the image that may show objects, by the spheres around these."""
        ahead, left, _ = ((self._centers - origin) @ rotation).T
        radius = self._radii
        in_front = ahead > 2.0 * radius
        with np.errstate(divide="ignore", invalid="ignore"):
            # the most that y / x of a point in the sphere differs from that of its centre
            spread = radius * np.hypot(ahead, left) / (ahead * (ahead - radius))
            inside = np.abs(LEFT_PER_AHEAD[:, None] - left / ahead) <= spread
        around = ~in_front & (ahead > -radius)
        return np.asarray((inside & in_front | around).any(axis=1))

    def _look_out_of_the_ground(
        self, origin: NDArray[np.float64], rays: NDArray[np.float32], hits: Hits
    ) -> None:
        """Correct the hits of unit rays (n, 3) that start inside of a wall.

        Ground has one side: from behind it is not there, and nothing is below it but the sky.
        """
        ground = hits.number == GROUND
        behind = ground & (np.einsum("ij,ij->i", hits.normal, rays) > 0.0)
        hits.number[ground & ~behind] = SKY  # the flat floor, which goes on below the walls
        through = np.flatnonzero(behind)
        if not len(through):
            return
        onward = rays[through]
        passed = hits.distance[through] + BEHIND
        start = origin + onward * passed[:, None]
        beyond = self._trace(start, onward, np.ones(len(onward), bool))
        hits.number[through] = beyond.number
        hits.distance[through] = beyond.distance + passed

    def _bare_radius(self, origin: NDArray[np.float64]) -> float:
        """Around a point, the radius [m] of flat floor on which nothing stands; 0 for none."""
        if origin[2] <= 0.0:  # the nose is in the ground
            return 0.0
        x, y = origin[:1], origin[1:2]
        radius = -float(self._terrain.outside_at(x, y)[0]) - 2 * SPACING
        if len(self._occupied):
            there = self._occupied
            away = np.hypot(there[:, 0] - x, there[:, 1] - y) - there[:, 2]
            radius = min(radius, float(np.min(away)))
        return max(0.0, radius)


@lru_cache(maxsize=1)  # of the world that is simulated again and again
def _ground_of(terrain: Terrain) -> MeshScene:
    return MeshScene([terrain.triangles()], GROUND)
