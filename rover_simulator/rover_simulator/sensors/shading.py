"""Colours of the canyon: its ground, its texture, and its sky, as means of what was measured.

Measured on recordings of the original: RGB of surfaces by range and by the angle to the sun.
"""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

SUN = np.array([0.321, -0.557, 0.766])  # east, north, up: towards the sun
SUN_AZIMUTH = math.atan2(SUN[1], SUN[0])

SAND_LIT = np.array([234, 215, 200], np.float32)
SAND_SHADOW = np.array([208, 189, 175], np.float32)
WALL_LIT, WALL_SHADOW = np.array([41, 28, 24], np.float32), np.array([19, 12, 9], np.float32)
# Sand by range [m]: brighter at the wheels, darker far ahead, as shares of that at 2.5 m.
SAND_RANGE = (0.4, 0.65, 1.0, 2.5, 4.0, 6.5, 10.0)
SAND_GAIN = (1.035, 1.03, 1.015, 1.0, 0.985, 0.97, 0.91)
# Sand is brighter in views away from the sun: 252 245 234 there, 227 207 192 to the side.
SHEEN = np.array([24, 27, 29.0], np.float32)  # [levels] above the mean
SHEEN_AT = SUN_AZIMUTH + math.radians(155)
SHEEN_TO = np.array([math.cos(SHEEN_AT), math.sin(SHEEN_AT)], np.float32)

# Red of the sky by elevation [deg]; green and blue are a little less of the same grey.
SKY_ELEVATION_DEG = (10.0, 14.0, 18.0, 22.0, 30.0, 34.0, 40.0)
SKY_RED = (168.0, 157.0, 145.0, 135.0, 122.0, 118.0, 111.0)
SKY_TINT = np.array([0, -9.3, -14.0], np.float32)
SKY_SUNWARD, SKY_ELSEWHERE = 30.0, -11.0  # [levels] toward the sun, and the same everywhere

SAND_TEXTURE = 0.8  # [levels] standard deviation
WALL_TEXTURE, WALL_RUST = 0.38, 0.02  # shares of its colour: of light, and of red against blue


def ground_colors(sand: NDArray[np.float32], shade: NDArray[np.float32]) -> NDArray[np.float32]:
    """Colours (rows, cols, 3) of the ground from above, from its shares 0..1 of sand and shadow.

    The texture is projected from above, so that it is stretched on steep walls, as in the
    original.
    """
    lit = sand[..., None] * (SAND_LIT - WALL_LIT) + WALL_LIT
    dark = sand[..., None] * (SAND_SHADOW - WALL_SHADOW) + WALL_SHADOW
    colors = lit + shade[..., None] * (dark - lit)
    shape, wall = sand.shape, 1.0 - sand
    light = noise(shape, 0.8, 0) + noise(shape, 2.0, 1) + noise(shape, 6.0, 2)
    light += 0.7 * noise(shape, 24.0, 3)
    rust = noise(shape, 10.0, 4) + noise(shape, 40.0, 5)
    light, rust = light / light.std(), rust / rust.std()
    colors *= np.maximum(1.0 + WALL_TEXTURE * wall * light, 0.2)[..., None]
    colors[..., 0] *= 1.0 + WALL_RUST * wall * rust
    colors[..., 2] *= 1.0 - WALL_RUST * wall * rust
    colors += (SAND_TEXTURE * sand * light)[..., None]
    return colors


def noise(shape: tuple[int, ...], sigma: float, seed: int) -> NDArray[np.float32]:
    """Smooth noise (rows, cols) of mean 0 and standard deviation 1; sigma in cells."""
    step = max(1, int(sigma / 2))  # wide noise is made on a coarser grid, for speed
    coarse = (-(-shape[0] // step), -(-shape[1] // step))
    values = np.random.default_rng(seed).standard_normal(coarse, np.float32)
    smooth = np.asarray(cv2.GaussianBlur(values, (0, 0), sigma / step))
    if step > 1:
        smooth = np.asarray(cv2.resize(smooth, shape[::-1], interpolation=cv2.INTER_CUBIC))
    return (smooth - smooth.mean()) / smooth.std()


def shine(
    colors: NDArray[np.float32],
    rays: NDArray[np.float32],
    level: NDArray[np.float32],
    distance: NDArray[np.float32],
) -> None:
    """Change ground (3, n), seen along rays (3, n) at distances (n,) [m], where it is bright.

    `level` (n,) is the length of the rays' horizontal parts.
    """
    bright = np.clip((colors[0] - 100.0) / 100.0, 0.0, 1.0)
    gain = np.interp(distance, SAND_RANGE, SAND_GAIN).astype(np.float32) - 1.0
    toward = rays[0] * SHEEN_TO[0] + rays[1] * SHEEN_TO[1]
    toward = np.maximum(toward, 0.0) / level  # cosine of an angle
    factor = 1.0 + bright * gain
    sheen = bright * np.square(np.square(toward))
    colors *= factor
    for plane, extra in zip(colors, SHEEN, strict=True):
        plane += sheen * extra


def from_sun(rays: NDArray[np.float32]) -> NDArray[np.float32]:
    """Azimuths (n,) [rad] of rays (3, n) in the map frame, counted from the sun's."""
    return np.arctan2(rays[1], rays[0]) - np.float32(SUN_AZIMUTH)


def sky_colors(rays: NDArray[np.float32]) -> NDArray[np.float32]:
    """Colours (3, n) of the sky along unit rays (3, n)."""
    elevation = np.degrees(np.arcsin(np.clip(rays[2], -1, 1)))
    red = np.interp(elevation, SKY_ELEVATION_DEG, SKY_RED)
    red += SKY_SUNWARD * np.maximum(0.0, np.cos(from_sun(rays))) + SKY_ELSEWHERE
    return (red + SKY_TINT[:, None]).astype(np.float32)
