"""Yellow blobs of one image, as rays towards the middle of a sample each."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_perception.camera.ground_projection import View

MIN_PIXELS = 3
# Samples are 0.09 to 0.17 m high and may be buried in the wall's foot by some centimetres. A blob's
# lowest row would tell where it stands, but from 3 m on it is no taller than the blur of its colour
# in the JPEG file, so its middle is followed instead.
MIDDLE_HEIGHT = 0.065  # [m] above the ground
MAX_RANGE = 12.0  # [m] beyond, a row of pixels is 6 m long
PIXEL_ERROR = 0.7  # [px] of a blob's middle
BODY_ERROR = 0.05  # [m] the sample's shape: its visible middle is not its centre
# The JPEG file holds colour in blocks of so many pixels, within which a sample tints what is dark;
# decoding carries that a little beyond. On generated canyons such tints were 1.8 to 5 times as pale
# as the sample beside them, and parts of one sample at most 1.5.
COLOR_BLOCK = 16  # [px]
BLOCK_EDGE = 2  # [px]
PALER = 1.5


@dataclass(frozen=True)
class RockSighting:
    """One blob: the line of sight to its middle, in the map frame with the ground at z = 0."""

    origin: NDArray[np.floating]  # (3,) [m] the camera
    direction: NDArray[np.floating]  # (3,) unit vector
    error: float  # [m] standard deviation across the line, at the sample


@dataclass(frozen=True)
class RockSightings:
    """All blobs of one frame, and their places around the rover."""

    rocks: tuple[RockSighting, ...]
    x: NDArray[np.floating]  # (n,) [m] level frame, below the middle of every blob
    y: NDArray[np.floating]

    @classmethod
    def none(cls) -> RockSightings:
        return cls((), np.empty(0), np.empty(0))


def detect_rocks(
    image: NDArray[np.uint8], mask: NDArray[np.uint8], view: View, pose: Pose
) -> RockSightings:
    """The blobs of the mask that are near and large enough to tell where they are."""
    if cv2.countNonZero(mask) < MIN_PIXELS:
        return RockSightings.none()
    stats, centroids = _blobs(image, mask)
    left, top, width, height, area = stats.T
    x, y = view.ground(centroids[:, 0] + 0.5, centroids[:, 1] + 0.5, MIDDLE_HEIGHT)
    distance = np.hypot(x - view.position[0], y - view.position[1])
    good = (area >= MIN_PIXELS) & (distance < MAX_RANGE)
    # a blob cut off by the image's edge is worth steering to, but its middle is elsewhere
    whole = (left > 0) & (left + width < mask.shape[1]) & (top + height < mask.shape[0])
    shown_x, shown_y = x[good], y[good]
    good &= whole
    x, y, distance = x[good], y[good], distance[good]
    c, s = np.cos(pose.yaw), np.sin(pose.yaw)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    origin = turn @ view.position + (pose.x, pose.y, 0.0)
    rays = np.stack([x, y, np.full_like(x, MIDDLE_HEIGHT)], axis=1) - view.position
    directions = rays @ turn.T / np.linalg.norm(rays, axis=1, keepdims=True)
    lift = view.height_error * view.height
    errors = np.sqrt((PIXEL_ERROR * distance / view.camera.focal) ** 2 + BODY_ERROR**2 + lift**2)
    rocks = tuple(
        RockSighting(origin, direction, float(error))
        for direction, error in zip(directions, errors, strict=True)  # a handful of blobs
    )
    return RockSightings(rocks, shown_x, shown_y)


def _blobs(
    image: NDArray[np.uint8], mask: NDArray[np.uint8]
) -> tuple[NDArray[np.integer], NDArray[np.floating]]:
    """Left, top, width, height and area (n, 5), and centroids (n, 2), of blobs that are no tint."""
    _, labels, stats, centroids = cv2.connectedComponentsWithStats(mask, connectivity=8)
    # the first is the background
    boxes, middles = np.asarray(stats[1:], np.intp), np.asarray(centroids[1:], float)
    if len(boxes) > 1:
        own = ~_is_tint(boxes, _yellow(image, np.asarray(labels, np.intp)))
        boxes, middles = boxes[own], middles[own]
    return boxes, middles


def _yellow(image: NDArray[np.uint8], labels: NDArray[np.integer]) -> NDArray[np.floating]:
    """Mean green above blue (n,) [levels] of each labelled blob."""
    row, col = np.nonzero(labels)
    above = image[row, col, 1].astype(float) - image[row, col, 2]
    label = labels[row, col]
    return np.bincount(label, above)[1:] / np.bincount(label)[1:]


def _is_tint(boxes: NDArray[np.integer], yellow: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Whether each blob (n,) is much paler than another one in the same block of colour."""
    corner, size = boxes[:, :2], boxes[:, 2:4]
    first = (corner - BLOCK_EDGE) // COLOR_BLOCK
    last = (corner + size - 1 + BLOCK_EDGE) // COLOR_BLOCK
    shared = ((first[:, None] <= last) & (first <= last[:, None])).all(axis=2)
    paler = yellow[:, None] * PALER < yellow
    return np.asarray((shared & paler).any(axis=1))
