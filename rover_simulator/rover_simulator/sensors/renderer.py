"""What the rover's camera sees of a world.

Colours are the measured means of the simulator's surfaces. Arrays are stored as one plane per
coordinate or colour, because numpy is slow along an axis of three.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ORIGIN_HEIGHT, ROVER_CAMERA
from rover_common.geometry import Pose, rotation_matrix
from rover_common.grid import WORLD
from rover_simulator.sensors.meshes import SKY
from rover_simulator.sensors.scene import GROUND, Scene
from rover_simulator.sensors.shading import SUN, ground_colors, noise, shine, sky_colors
from rover_simulator.world.terrain import FINE, Terrain
from rover_simulator.world.wall_profile import sand_at
from rover_simulator.world.world import World

BOULDER = np.array([17, 13, 10.0], np.float32)
SAMPLE = np.array([170, 143, 15.0], np.float32)  # lit by itself, so that it is the same in shadow
FOG = np.array([139, 125, 114.0], np.float32)
FOG_DENSITY = 0.005  # [1/m], exponential squared
PAINT = FINE  # [1/m] colours of the ground
SHADOW = 4  # [1/m] its shadows, whose edges are soft
SHADOW_BIAS = 0.05  # [m] above the ground, so that it does not shade itself
GRAIN_SCALE = 5  # texels of the fine texture per one of the paint: 40 per metre
GRAIN_SIZE = 512  # texels after which the fine texture repeats; a power of two
GRAIN = 0.06  # standard deviation of the fine texture near the camera, as a share of the colour
GRAIN_RANGE = 0.8  # [m] over which it fades
HEIGHT, WIDTH = ROVER_CAMERA.height, ROVER_CAMERA.width


@dataclass(frozen=True)
class Rendering:
    image: NDArray[np.uint8]  # (160, 320, 3) RGB
    sample_pixels: NDArray[np.intp]  # (n,) pixels in which each of the world's samples shows


class Renderer:
    """Renders one world; geometry, shadows and colours of the ground are made once."""

    def __init__(self, world: World, terrain: Terrain) -> None:
        self._scene = Scene(world, terrain)
        self._colors = _painted(world, terrain)
        rays = ROVER_CAMERA.rays().reshape(-1, 3)
        rays /= np.linalg.norm(rays, axis=1, keepdims=True)
        self._rays = np.ascontiguousarray(rays.T)
        self._grain = GRAIN * noise((GRAIN_SIZE, GRAIN_SIZE), 1.2, seed=7)

    def hide_sample(self, x: float, y: float) -> bool:
        """Whether a sample was at this place [m], which now is gone."""
        return self._scene.hide_sample(x, y)

    def render(self, pose: Pose, ground: float = 0.0, first_row: int = 0) -> Rendering:
        """What the camera sees at a pose on ground of this height [m].

        Rows above `first_row` stay black, and samples in them are not counted.
        """
        rotation = rotation_matrix(pose)
        origin = np.array([pose.x, pose.y, ground + ORIGIN_HEIGHT])
        origin = origin + rotation @ np.array([ROVER_CAMERA.forward, 0.0, ROVER_CAMERA.up])
        rays = rotation.astype(np.float32) @ self._rays[:, first_row * WIDTH :]
        level = np.hypot(rays[0], rays[1])
        hit, distance = self._scene.cast(origin, rotation, rays, level)
        x, y = (np.float32(origin[axis]) + rays[axis] * distance for axis in (0, 1))
        colors, grain = self._ground(x, y)
        grain *= np.exp(-distance / GRAIN_RANGE)
        colors *= 1.0 + grain
        shine(colors, rays, level, distance)
        things = np.flatnonzero(hit > GROUND)
        is_sample = hit[things] <= self._scene.sample_count
        samples, boulders = things[is_sample], things[~is_sample]
        colors[:, samples] = SAMPLE[:, None]
        colors[:, boulders] = BOULDER[:, None] * (1.0 + 4.0 * grain[boulders])
        fog = 1.0 - np.exp(-np.square(FOG_DENSITY * distance))
        for plane, color in zip(colors, FOG, strict=True):
            plane += fog * (color - plane)
        sky = np.flatnonzero(hit == SKY)
        colors[:, sky] = sky_colors(rays[:, sky])
        levels = np.clip(colors, 0, 255).astype(np.uint8)
        image = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
        image[first_row:] = cv2.merge([plane.reshape(-1, WIDTH) for plane in levels])
        pixels = np.bincount(hit[samples] - 1, minlength=self._scene.sample_count)
        return Rendering(image, pixels)

    def _ground(
        self, x: NDArray[np.float32], y: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Colours (3, n) of the ground at points (n,) [m], and its fine texture (n,)."""
        # remap takes no long lines
        x, y = ((line * PAINT - 0.5).reshape(-1, WIDTH) for line in (x, y))
        painted = cv2.remap(self._colors, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        x, y = (_wrapped(line * GRAIN_SCALE) for line in (x, y))
        fine = cv2.remap(self._grain, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP)
        planes = np.stack(cv2.split(painted)).reshape(3, -1)
        return np.asarray(planes, np.float32), np.asarray(fine, np.float32).ravel()


@lru_cache(maxsize=1)  # of the world that is simulated again and again
def _painted(world: World, terrain: Terrain) -> NDArray[np.float32]:
    """Colours of the ground seen from above, (200 PAINT, 200 PAINT, 3), with its shadows."""
    x, y = _grid(SHADOW)
    start = np.stack([x, y, terrain.height_at(x, y) + SHADOW_BIAS], axis=1)
    blocked = Scene(world, terrain).is_blocked(start, SUN)
    cells, shadow_cells = round(WORLD.size * PAINT), round(WORLD.size * SHADOW)
    shade = blocked.reshape(shadow_cells, shadow_cells).astype(np.float32)
    shade = np.asarray(cv2.resize(shade, (cells, cells), interpolation=cv2.INTER_LINEAR))
    sand = sand_at(terrain.outside).astype(np.float32)
    return ground_colors(sand, shade)


def _wrapped(texels: NDArray[np.float32]) -> NDArray[np.float32]:
    """The same place in the first repetition of the fine texture, exactly.

    `remap` wraps as well, but it is slow where most of what is asked for lies outside.
    """
    return texels - GRAIN_SIZE * np.floor(texels / GRAIN_SIZE)


def _grid(density: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """x and y (n,) [m] of the middles of all cells, row by row; density in cells per metre."""
    at = (np.arange(round(WORLD.size * density)) + 0.5) / density
    x, y = np.meshgrid(at, at)
    return x.ravel(), y.ravel()
