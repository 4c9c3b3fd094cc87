"""What the rover's camera sees of a world: rays against its terrain and samples.

Colours are the measured means of the simulator's surfaces.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
from numpy.typing import NDArray

from rover_common.camera import ORIGIN_HEIGHT, ROVER_CAMERA
from rover_common.geometry import Pose, rotation_matrix
from rover_common.grid import WORLD_SIZE
from rover_simulator.sensors.shading import SUN, ground_colors, noise, shine, sky_colors
from rover_simulator.world import boulders
from rover_simulator.world.profile import sand_at
from rover_simulator.world.terrain import SPACING, Terrain
from rover_simulator.world.world import World

BOULDER = np.array([17, 13, 10.0], np.float32)
SAMPLE = np.array([170, 143, 15.0], np.float32)  # lit by itself, so that it is the same in shadow
FOG = np.array([139, 125, 114.0], np.float32)
FOG_DENSITY = 0.005  # [1/m], exponential squared
PAINT = 8  # [1/m] colours of the ground
SHADOW = 4  # [1/m] its shadows, whose edges are soft
GRAIN_SCALE = 5  # texels of the fine texture per one of the paint: 40 per metre
BEYOND = 1e-3  # [m] past the ground that is seen from behind
SHADOW_BIAS = 0.05  # [m] above the ground, so that it does not shade itself
TEXTURE = 0.06  # of the ground's colour: its fine texture near the camera, one pixel from afar
TEXTURE_RANGE = 0.8  # [m] over which it fades
HEIGHT, WIDTH = ROVER_CAMERA.height, ROVER_CAMERA.width

SAMPLE_RADIUS, SAMPLE_HEIGHT = 0.08, 0.13  # [m]


@dataclass(frozen=True)
class Rendering:
    image: NDArray[np.uint8]  # (160, 320, 3) RGB
    sample_pixels: NDArray[np.intp]  # (n,) pixels in which each of the world's samples shows


class Renderer:
    """Renders one world; geometry, shadows and colours of the ground are made once."""

    def __init__(self, world: World, terrain: Terrain) -> None:
        self._samples = world.samples.copy()
        self._solids = [terrain.triangles()]
        self._solids += [_sample_mesh(float(x), float(y)) for x, y in world.samples]
        self._solids += [boulders.mesh(boulder) for boulder in world.boulders]
        self._build_scene()
        self._terrain = terrain
        self._colors = self._paint(terrain)
        boulders_at = [(boulder.x, boulder.y, boulder.radius) for boulder in world.boulders]
        samples_at = [(float(x), float(y), SAMPLE_RADIUS) for x, y in world.samples]
        self._standing = np.array(boulders_at + samples_at).reshape(-1, 3)
        rays = ROVER_CAMERA.rays().reshape(-1, 3)
        self._rays = rays / np.linalg.norm(rays, axis=1, keepdims=True)
        self._grain = TEXTURE * noise((512, 512), 1.2, seed=7)

    def hide_sample(self, x: float, y: float) -> bool:
        """Whether a sample was at this place [m], which now is gone; takes half a second."""
        there = np.flatnonzero((self._samples == (x, y)).all(axis=1))
        for index in there:
            self._samples[index] = np.nan
            vertices, triangles = self._solids[index + 1]
            # Below all ground, because the meshes are known by their order.
            self._solids[index + 1] = (vertices - np.array([0, 0, 1000], np.float32), triangles)
            self._build_scene()
        return len(there) > 0

    def _build_scene(self) -> None:
        self._scene = rtcore_scene.EmbreeScene()
        self._meshes = [TriangleMesh(self._scene, *solid) for solid in self._solids]

    def render(self, pose: Pose, ground: float = 0.0, first_row: int = 0) -> Rendering:
        """What the camera sees at a pose on ground of this height [m].

        Rows above `first_row` stay black, and samples in them are not counted.
        """
        rotation = rotation_matrix(pose)
        origin = np.array([pose.x, pose.y, ground + ORIGIN_HEIGHT])
        origin = origin + rotation @ np.array([ROVER_CAMERA.forward, 0.0, ROVER_CAMERA.up])
        rays = self._rays[first_row * WIDTH :] @ rotation.T.astype(np.float32)
        geometry, distance = self._cast(origin, rays)
        # One array per coordinate and colour: numpy is slow along an axis of three.
        x, y = (np.float32(origin[axis]) + rays[:, axis] * distance for axis in (0, 1))
        colors, grain = self._ground(x, y)
        grain *= np.exp(-distance / TEXTURE_RANGE)
        colors *= 1.0 + grain
        shine(colors, rays, distance)
        self._color_things(colors, geometry, grain)
        fog = 1.0 - np.exp(-((FOG_DENSITY * distance) ** 2))
        for plane, color in zip(colors, FOG, strict=True):
            plane += fog * (color - plane)
        sky = np.flatnonzero(geometry < 0)
        colors[:, sky] = sky_colors(rays[sky]).T
        levels = np.clip(colors, 0, 255).astype(np.uint8)
        image = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
        image[first_row:] = cv2.merge([plane.reshape(-1, WIDTH) for plane in levels])
        pixels = np.bincount(geometry[geometry >= 0], minlength=len(self._meshes))[1:]
        return Rendering(image, pixels[: len(self._samples)])

    def _cast(
        self, origin: NDArray[np.float64], rays: NDArray[np.float32]
    ) -> tuple[NDArray[np.integer], NDArray[np.float32]]:
        """What unit rays (n, 3) meet, -1 the sky, and how far away [m], 0 for the sky.

        Rays that come down on the bare floor around the camera need no search: half of the image.
        """
        reach = self._bare(origin)
        level = np.hypot(rays[:, 0], rays[:, 1])
        plain = level * np.float32(origin[2]) < -rays[:, 2] * np.float32(reach)
        plain &= reach > 0.0
        geometry = np.zeros(len(rays), np.int32)
        distance = np.zeros(len(rays), np.float32)
        found, searched = np.flatnonzero(plain), np.flatnonzero(~plain)
        distance[found] = -origin[2] / rays[found, 2]
        if len(searched):
            there = rays[searched]
            hit = self._trace(np.broadcast_to(origin, there.shape), there)
            if self._terrain.height_at_point(*origin[:2].tolist()) > origin[2]:
                self._look_out_of_the_ground(origin, there, hit)
            geometry[searched] = hit["geomID"]
            distance[searched] = np.where(hit["geomID"] >= 0, hit["tfar"], 0.0)
        return geometry, distance

    def _look_out_of_the_ground(
        self, origin: NDArray[np.float64], rays: NDArray[np.float32], hit: dict[str, NDArray]
    ) -> None:
        """Correct what unit rays (n, 3) meet that start inside of a wall.

        Ground has one side: from behind it is not there, and nothing is below it but the sky.
        """
        ground = hit["geomID"] == 0
        behind = ground & (np.einsum("ij,ij->i", hit["Ng"], rays) > 0.0)
        hit["geomID"][ground & ~behind] = -1  # the flat floor, which goes on below the walls
        through = np.flatnonzero(behind)
        if not len(through):
            return
        onward = rays[through]
        passed = hit["tfar"][through] + BEYOND
        beyond = self._trace(origin + onward * passed[:, None], onward)
        hit["geomID"][through] = beyond["geomID"]
        hit["tfar"][through] = beyond["tfar"] + passed

    def _bare(self, origin: NDArray[np.float64]) -> float:
        """Below a point, the radius [m] of flat floor on which nothing stands; 0 for none."""
        if origin[2] <= 0.0:  # the nose is in the ground
            return 0.0
        x, y = origin[:1], origin[1:2]
        reach = -float(self._terrain.outside_at(x, y)[0]) - 2 * SPACING
        if len(self._standing):
            there = self._standing
            reach = min(
                reach, float(np.min(np.hypot(there[:, 0] - x, there[:, 1] - y) - there[:, 2]))
            )
        return max(0.0, reach)

    def _ground(
        self, x: NDArray[np.float32], y: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Colours (3, n) of the ground at points (n,) [m], and its fine texture (n,)."""
        # remap takes no long lines
        x, y = ((line * PAINT - 0.5).reshape(-1, WIDTH) for line in (x, y))
        painted = cv2.remap(self._colors, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        fine = cv2.remap(
            self._grain, x * GRAIN_SCALE, y * GRAIN_SCALE, cv2.INTER_LINEAR, None, cv2.BORDER_WRAP
        )
        planes = np.array(cv2.split(painted), np.float32).reshape(3, -1)
        return planes, np.asarray(fine, np.float32).ravel()

    def _color_things(
        self,
        colors: NDArray[np.float32],
        geometry: NDArray[np.integer],
        grain: NDArray[np.float32],
    ) -> None:
        """Change colours (3, n) where samples and boulders are seen."""
        things = np.flatnonzero(geometry > 0)
        is_sample = geometry[things] <= len(self._samples)
        colors[:, things[is_sample]] = SAMPLE[:, None]
        boulder = things[~is_sample]
        colors[:, boulder] = BOULDER[:, None] * (1.0 + 4.0 * grain[boulder])

    def _paint(self, terrain: Terrain) -> NDArray[np.float32]:
        """Colours of the ground seen from above, (200 PAINT, 200 PAINT, 3), with its shadows."""
        x, y = _grid(SHADOW)
        start = np.stack([x, y, terrain.height_at(x, y) + SHADOW_BIAS], axis=1)
        blocked = self._trace(start, np.broadcast_to(SUN, start.shape))["geomID"] >= 0
        cells, shadow_cells = round(WORLD_SIZE * PAINT), round(WORLD_SIZE * SHADOW)
        shade = blocked.reshape(shadow_cells, shadow_cells).astype(np.float32)
        shade = np.asarray(cv2.resize(shade, (cells, cells), interpolation=cv2.INTER_LINEAR))
        sand = sand_at(terrain.outside_at(*_grid(PAINT))).astype(np.float32)
        return ground_colors(sand.reshape(cells, cells), shade)

    def _trace(self, origins: NDArray, directions: NDArray) -> dict[str, NDArray]:
        result: dict[str, NDArray] = self._scene.run(
            np.ascontiguousarray(origins, np.float32),
            np.ascontiguousarray(directions, np.float32),
            output=1,
        )
        return result


def _grid(density: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """x and y (n,) [m] of the middles of all cells, row by row; density in cells per metre."""
    at = (np.arange(round(WORLD_SIZE * density)) + 0.5) / density
    x, y = np.meshgrid(at, at)
    return x.ravel(), y.ravel()


def _sample_mesh(x: float, y: float) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """A rock of eight sides; its foot is at the floor's height, also where the ground is higher."""
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
