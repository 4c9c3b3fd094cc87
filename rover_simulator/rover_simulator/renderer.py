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
from rover_simulator import boulders
from rover_simulator.profile import sand_at
from rover_simulator.terrain import Terrain
from rover_simulator.world import World

SAND_LIT, SAND_SHADOW = np.array([238, 220, 205.0]), np.array([208, 189, 175.0])
WALL_LIT, WALL_SHADOW = np.array([41, 28, 24.0]), np.array([19, 12, 9.0])
BOULDER = np.array([17, 13, 10.0], np.float32)
SAMPLE = np.array([170, 143, 15.0], np.float32)  # lit by itself, so that it is the same in shadow
SKY_LOW = np.array([157, 148, 143.0], np.float32)
SKY_HIGH = np.array([112, 104, 99.0], np.float32)
SKY_LOW_AT, SKY_HIGH_AT = math.radians(13), math.radians(36)  # elevations of these colours
FOG = np.array([139, 125, 114.0], np.float32)
FOG_DENSITY = 0.005  # [1/m], exponential squared
SUN = np.array([0.321, -0.557, 0.766])  # east, north, up: towards the sun
PAINT = 8  # [1/m] colours of the ground
GRAIN = 20  # [1/m] its texture
SHADOW_BIAS = 0.05  # [m] above the ground, so that it does not shade itself
TEXTURE = 6.0  # grey levels of the surfaces' texture
JPEG_QUALITY = 75

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
        self._colors = self._paint(terrain)
        rays = ROVER_CAMERA.rays().reshape(-1, 3)
        self._rays = rays / np.linalg.norm(rays, axis=1, keepdims=True)
        self._grain = _grain()

    def hide_sample(self, x: float, y: float) -> None:
        """The sample at this place [m], if one is there, is gone; takes half a second."""
        for index in np.flatnonzero((self._samples == (x, y)).all(axis=1)):
            self._samples[index] = np.nan
            vertices, triangles = self._solids[index + 1]
            # Below all ground, because the meshes are known by their order.
            self._solids[index + 1] = (vertices - np.array([0, 0, 1000], np.float32), triangles)
            self._build_scene()

    def _build_scene(self) -> None:
        self._scene = rtcore_scene.EmbreeScene()
        self._meshes = [TriangleMesh(self._scene, *solid) for solid in self._solids]

    def render(self, pose: Pose, ground: float = 0.0) -> Rendering:
        """What the camera sees at a pose on ground of this height [m]."""
        rotation = rotation_matrix(pose)
        origin = np.array([pose.x, pose.y, ground + ORIGIN_HEIGHT])
        origin = origin + rotation @ np.array([ROVER_CAMERA.forward, 0.0, ROVER_CAMERA.up])
        rays = self._rays @ rotation.T.astype(np.float32)
        hit = self._trace(np.broadcast_to(origin, rays.shape), rays)
        geometry = hit["geomID"]
        distance = np.where(geometry >= 0, hit["tfar"], 0.0).astype(np.float32)[:, None]
        points = origin.astype(np.float32) + rays * distance
        surface = self._surface(points, geometry)
        fog = 1.0 - np.exp(-((FOG_DENSITY * distance) ** 2))
        colors = np.where(geometry[:, None] >= 0, surface + fog * (FOG - surface), _sky(rays))
        image = colors.reshape(ROVER_CAMERA.height, ROVER_CAMERA.width, 3)
        pixels = np.bincount(geometry[geometry >= 0], minlength=len(self._meshes))[1:]
        return Rendering(np.clip(image, 0, 255).astype(np.uint8), pixels[: len(self._samples)])

    def _surface(self, points: NDArray[np.float32], geometry: NDArray[np.integer]) -> NDArray:
        """Colours (n, 3) of points (n, 3) [m] on the ground, on samples or on boulders."""
        shape = (ROVER_CAMERA.height, ROVER_CAMERA.width)  # remap takes no long columns
        x, y = ((points[:, axis] * PAINT - 0.5).reshape(shape) for axis in (0, 1))
        painted = cv2.remap(self._colors, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        fine = (points * GRAIN).astype(np.int32)
        grain = self._grain[(fine[:, 1] + fine[:, 2]) % 512, fine[:, 0] % 512]
        colors = painted.reshape(-1, 3) + grain[:, None]
        colors[(geometry > 0) & (geometry <= len(self._samples))] = SAMPLE
        is_boulder = geometry > len(self._samples)
        colors[is_boulder] = BOULDER + grain[is_boulder, None]
        return colors

    def _paint(self, terrain: Terrain) -> NDArray[np.float32]:
        """Colours of the ground seen from above, (200 PAINT, 200 PAINT, 3), with its shadows."""
        at = (np.arange(round(WORLD_SIZE * PAINT)) + 0.5) / PAINT
        x, y = (axis.ravel() for axis in np.meshgrid(at, at))
        start = np.stack([x, y, terrain.height_at(x, y) + SHADOW_BIAS], axis=1)
        blocked = self._trace(start, np.broadcast_to(SUN, start.shape))["geomID"] >= 0
        sand = sand_at(terrain.outside_at(x, y))[:, None]
        lit = sand * SAND_LIT + (1 - sand) * WALL_LIT
        shadow = sand * SAND_SHADOW + (1 - sand) * WALL_SHADOW
        colors = np.where(blocked[:, None], shadow, lit)
        return colors.reshape(len(at), len(at), 3).astype(np.float32)

    def _trace(self, origins: NDArray, directions: NDArray) -> dict[str, NDArray]:
        result: dict[str, NDArray] = self._scene.run(
            np.ascontiguousarray(origins, np.float32),
            np.ascontiguousarray(directions, np.float32),
            output=1,
        )
        return result


def _grain() -> NDArray[np.float32]:
    """The surfaces' texture (512, 512) in grey levels."""
    noise = np.random.default_rng(7).normal(size=(512, 512))
    texture = np.asarray(cv2.GaussianBlur(noise, (0, 0), 1.2))
    return (TEXTURE / texture.std() * texture).astype(np.float32)


def encode_jpeg(image: NDArray[np.uint8]) -> bytes:
    """A JPEG file as the simulator writes it: quality 75, colour at half resolution."""
    parameters = [
        cv2.IMWRITE_JPEG_QUALITY,
        JPEG_QUALITY,
        cv2.IMWRITE_JPEG_SAMPLING_FACTOR,
        cv2.IMWRITE_JPEG_SAMPLING_FACTOR_420,
    ]
    _, data = cv2.imencode(".jpg", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), parameters)
    return data.tobytes()


def _sky(rays: NDArray[np.float32]) -> NDArray:
    """Colours (n, 3) of the sky along unit rays (n, 3)."""
    elevation = np.arcsin(np.clip(rays[:, 2], -1, 1))
    share = np.clip((elevation - SKY_LOW_AT) / (SKY_HIGH_AT - SKY_LOW_AT), 0, 1)[:, None]
    return (1 - share) * SKY_LOW + share * SKY_HIGH


def _sample_mesh(x: float, y: float) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """A rock of eight sides that stands on the ground."""
    angle = np.arange(8) * math.pi / 4
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1) * SAMPLE_RADIUS
    low = np.column_stack([ring + np.array([x, y]), np.zeros(8)])
    high = np.column_stack([0.75 * ring + np.array([x, y]), np.full(8, 0.7 * SAMPLE_HEIGHT)])
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
