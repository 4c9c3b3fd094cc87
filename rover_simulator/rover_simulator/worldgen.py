"""Draw a canyon from a seed: an open centre, winding arms with dead ends, samples at the walls."""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.random import Generator, default_rng
from numpy.typing import NDArray
from scipy import ndimage

from rover_common.geometry import Pose
from rover_simulator.world import World

SCALE = 4  # pixels per metre while drawing
BORDER = 15.0  # [m] kept free of canyon at the world's edge
SAMPLES = 6


def generate_world(seed: int, size: float = 1.0) -> World:
    """The canyon of a seed; `size` scales the length of its arms, 1 for that of the original."""
    random = default_rng(seed)
    center = random.uniform(85, 115, 2)
    picture = np.zeros((200 * SCALE, 200 * SCALE), np.uint8)
    _blob(picture, center, random.uniform(6, 9), random)
    heading = random.uniform(0, 2 * math.pi)
    arms = 4
    for arm in range(arms):
        angle = heading + arm * 2 * math.pi / arms + random.normal(0, 0.25)
        length = size * random.uniform(45, 80)
        end, angle = _corridor(picture, center, angle, length, random)
        _blob(picture, end, random.uniform(3, 6), random)
        middle_angle = angle + random.choice((-1, 1)) * random.uniform(0.9, 1.4)
        _corridor(picture, end, middle_angle, size * random.uniform(8, 16), random)
    navigable = _to_cells(picture, center)
    return World(
        name=f"seed-{seed}",
        navigable=navigable,
        samples=_place_samples(navigable, center, random),
        start=Pose(float(center[0]), float(center[1]), float(random.uniform(-math.pi, math.pi))),
    )


def _corridor(
    picture: NDArray[np.uint8],
    start: NDArray[np.float64],
    angle: float,
    length: float,
    random: Generator,
) -> tuple[NDArray[np.float64], float]:
    """Draw a winding corridor; returns its end [m] and its last direction [rad]."""
    point = np.array(start, float)
    width = random.uniform(4.0, 7.0)
    bend = 0.0
    for _ in range(max(1, round(length))):
        bend = 0.9 * bend + random.normal(0, 0.035)
        width = float(np.clip(width + random.normal(0, 0.35), 3.2, 10.0))
        angle += bend
        to_middle = math.atan2(100 - point[1], 100 - point[0])
        if np.any(point < BORDER) or np.any(point > 200 - BORDER):
            angle = to_middle
        point = point + np.array([math.cos(angle), math.sin(angle)])
        cv2.circle(picture, _pixel(point), round(width / 2 * SCALE), 255, -1)
    return point, angle


def _blob(
    picture: NDArray[np.uint8], center: NDArray[np.float64], radius: float, random: Generator
) -> None:
    for _ in range(6):
        offset = random.normal(0, radius / 2.5, 2)
        cv2.circle(picture, _pixel(center + offset), round(radius * 0.7 * SCALE), 255, -1)
    cv2.circle(picture, _pixel(center), round(radius * 0.6 * SCALE), 255, -1)


def _pixel(point: NDArray[np.float64]) -> tuple[int, int]:
    return round(float(point[0]) * SCALE), round(float(point[1]) * SCALE)


def _to_cells(picture: NDArray[np.uint8], center: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Navigable cells of 1 m: smooth outlines, one connected region."""
    smooth = cv2.GaussianBlur(picture, (0, 0), 0.8 * SCALE)
    cells = smooth.reshape(200, SCALE, 200, SCALE).mean(axis=(1, 3)) > 127
    labels, _ = ndimage.label(cells)
    return labels == labels[int(center[1]), int(center[0])]


def _place_samples(
    navigable: NDArray[np.bool_], center: NDArray[np.float64], random: Generator
) -> NDArray[np.float64]:
    """Samples near the walls, away from the start and from each other; some just off the map."""
    depth = ndimage.distance_transform_edt(navigable)
    beyond = ndimage.distance_transform_edt(~navigable)
    near_wall = (navigable & (depth <= 1.5)) | (~navigable & (beyond <= 1.0))
    rows, cols = np.nonzero(near_wall)
    points = np.stack([cols + 0.5, rows + 0.5], axis=1)
    points = points[np.hypot(*(points - center).T) > 12.0]
    chosen: list[NDArray[np.float64]] = []
    for index in random.permutation(len(points)):
        point = points[index] + random.uniform(-0.3, 0.3, 2)
        if all(np.hypot(*(point - other)) > 10.0 for other in chosen):
            chosen.append(point)
        if len(chosen) == SAMPLES:
            break
    return np.array(chosen).reshape(-1, 2)
