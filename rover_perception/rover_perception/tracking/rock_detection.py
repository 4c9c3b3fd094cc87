"""Yellow blobs of one image, each as a line of sight to the middle of a rock sample."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_perception.camera.ground_projection import GroundProjection

MIN_PIXELS = 3
# Samples are 0.09 to 0.17 m high and may be buried in a wall's base by some centimetres. A blob's
# lowest row would give its position, but from 3 m on a blob is no taller than its chroma blur in
# the JPEG file, so its middle is used instead.
MIDDLE_HEIGHT = 0.065  # [m] above the ground
MAX_RANGE = 12.0  # [m] beyond, a row of pixels is 6 m long
PIXEL_ERROR = 0.7  # [px] of a blob's middle
BODY_ERROR = 0.05  # [m] the sample's shape: its visible middle is not its centre
# JPEG stores chroma in blocks of this size, within which a sample tints dark pixels; decoding
# spreads the tint a little beyond. On generated canyons such tints were 1.8 to 5 times as pale as
# the sample next to them, and parts of one sample at most 1.5 times.
CHROMA_BLOCK = 16  # [px]
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
    """All blobs of one frame, and their positions around the rover."""

    rocks: tuple[RockSighting, ...]
    x: NDArray[np.floating]  # (n,) [m] level frame, below the middle of every blob
    y: NDArray[np.floating]

    @classmethod
    def none(cls) -> RockSightings:
        return cls((), np.empty(0), np.empty(0))


def detect_rocks(
    image: NDArray[np.uint8], mask: NDArray[np.uint8], projection: GroundProjection, pose: Pose
) -> RockSightings:
    """The blobs of a rock mask (height, width) that are near and large enough to be located.

    `pose`: at which the image (height, width, 3) was taken.
    """
    if cv2.countNonZero(mask) < MIN_PIXELS:
        return RockSightings.none()
    boxes, centroids = _blobs(image, mask)
    left, top, width, height, area = boxes.T
    x, y = projection.ground(centroids[:, 0] + 0.5, centroids[:, 1] + 0.5, MIDDLE_HEIGHT)
    distance = np.hypot(x - projection.position[0], y - projection.position[1])
    good = (area >= MIN_PIXELS) & (distance < MAX_RANGE)
    # a blob cut off by the image's edge has its middle elsewhere: it gives a position, but no line
    whole = (left > 0) & (left + width < mask.shape[1]) & (top + height < mask.shape[0])
    lines = _lines_of_sight(x[good & whole], y[good & whole], projection, pose)
    return RockSightings(lines, x[good], y[good])


def _lines_of_sight(
    x: NDArray[np.floating], y: NDArray[np.floating], projection: GroundProjection, pose: Pose
) -> tuple[RockSighting, ...]:
    """From the camera to the points (x, y) [m] of the level frame, at MIDDLE_HEIGHT."""
    position = projection.position
    distance = np.hypot(x - position[0], y - position[1])
    c, s = np.cos(pose.yaw), np.sin(pose.yaw)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    origin = turn @ position + (pose.x, pose.y, 0.0)
    rays = np.stack([x, y, np.full_like(x, MIDDLE_HEIGHT)], axis=1) - position
    directions = rays @ turn.T / np.linalg.norm(rays, axis=1, keepdims=True)
    pixel = PIXEL_ERROR * distance / projection.camera.focal
    lift = projection.height_error * projection.height
    errors = np.sqrt(pixel**2 + BODY_ERROR**2 + lift**2)
    return tuple(
        RockSighting(origin, direction, float(error))
        for direction, error in zip(directions, errors, strict=True)  # a handful of blobs
    )


def _blobs(
    image: NDArray[np.uint8], mask: NDArray[np.uint8]
) -> tuple[NDArray[np.integer], NDArray[np.floating]]:
    """Boxes (n, 5) as left, top, width, height and area, and centroids (n, 2); without tints."""
    _, labels, stats, centroids = cv2.connectedComponentsWithStats(mask, connectivity=8)
    # the first is the background
    boxes, middles = np.asarray(stats[1:], np.intp), np.asarray(centroids[1:], float)
    if len(boxes) > 1:
        own = ~_is_tint(boxes, _yellow(image, np.asarray(labels, np.intp)))
        boxes, middles = boxes[own], middles[own]
    return boxes, middles


def _yellow(image: NDArray[np.uint8], labels: NDArray[np.integer]) -> NDArray[np.floating]:
    """Mean difference of green and blue (n,) [levels] of each labelled blob."""
    row, col = np.nonzero(labels)
    above = image[row, col, 1].astype(float) - image[row, col, 2]
    label = labels[row, col]
    return np.bincount(label, above)[1:] / np.bincount(label)[1:]


def _is_tint(boxes: NDArray[np.integer], yellow: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Whether each blob (n,) is much paler than another one in the same chroma block."""
    corner, size = boxes[:, :2], boxes[:, 2:4]
    first = (corner - BLOCK_EDGE) // CHROMA_BLOCK
    last = (corner + size - 1 + BLOCK_EDGE) // CHROMA_BLOCK
    shared = ((first[:, None] <= last) & (first <= last[:, None])).all(axis=2)
    paler = yellow[:, None] * PALER < yellow
    return np.asarray((shared & paler).any(axis=1))
