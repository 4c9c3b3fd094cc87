"""Yellow blobs of one image, and where on the ground they stand."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_perception.classes import yellowness
from rover_perception.view import View

MIN_PIXELS = 3
# At a distance a blob is no taller than the blur of its colour: its middle is then known better
# than its lower end. Samples are 0.09 to 0.17 m high.
MIDDLE_HEIGHT = 0.065  # [m]
# A sample may be buried in the wall's foot by some centimetres, and its height is not known: 0.02 m
# of the 0.16 m from its middle up to the camera.
HEIGHT_ERROR = 0.12  # of the distance
MIDDLE_FROM = 3.0  # [m] where both are equally good
ROCK_RADIUS = 0.08  # [m] half of 0.13 to 0.19: the centre lies this far behind the foremost point
ROW_ERROR = 1.0  # [px] of a blob's lowest row
COLUMN_ERROR = 1.0  # [px] of its middle
BODY_ERROR = 0.05  # [m] the rock's shape
MAX_RANGE = 12.0  # [m] beyond, a row of pixels is 6 m long


@dataclass(frozen=True)
class RockSighting:
    """One blob, in the map frame."""

    x: float  # [m]
    y: float  # [m]
    covariance: NDArray[np.floating]  # (2, 2) [m^2]


@dataclass(frozen=True)
class RockSightings:
    """All blobs of one frame, and their cells around the rover."""

    rocks: tuple[RockSighting, ...]
    x: NDArray[np.floating]  # (n,) [m] level frame, of every blob's ground point
    y: NDArray[np.floating]

    @classmethod
    def none(cls) -> RockSightings:
        return cls((), np.empty(0), np.empty(0))


def detect_rocks(
    image: NDArray[np.uint8], mask: NDArray[np.uint8], view: View, pose: Pose
) -> RockSightings:
    """Locate each blob of the mask by its lowest row, where it touches the ground."""
    if cv2.countNonZero(mask) < MIN_PIXELS:
        return RockSightings.none()
    _, _, stats, centroids = cv2.connectedComponentsWithStats(mask, connectivity=8)
    stats, centroids = stats[1:], centroids[1:]  # the first is the background
    yellow = yellowness(image)
    bottom = np.array([_lowest_row(yellow, box) for box in stats[:, :4]])  # a handful of blobs
    u = centroids[:, 0] + 0.5
    x, y = view.ground(u, bottom)
    middle_x, middle_y = view.ground(u, centroids[:, 1] + 0.5, MIDDLE_HEIGHT)
    distance = np.hypot(middle_x - view.position[0], middle_y - view.position[1])
    far = distance > MIDDLE_FROM
    x, y = np.where(far, middle_x, x), np.where(far, middle_y, y)
    distance = np.hypot(x - view.position[0], y - view.position[1])
    good = (stats[:, cv2.CC_STAT_AREA] >= MIN_PIXELS) & (distance < MAX_RANGE)
    good &= (
        bottom < mask.shape[0] - 1
    )  # a blob cut off by the image's edge stands nobody knows where
    x, y, distance = x[good], y[good], distance[good]
    stretch = 1.0 + np.where(far[good], 0.0, ROCK_RADIUS) / np.maximum(distance, 0.1)
    x = view.position[0] + (x - view.position[0]) * stretch
    y = view.position[1] + (y - view.position[1]) * stretch
    rocks = tuple(
        _sighting(float(px), float(py), float(d), view, pose)
        for px, py, d in zip(x, y, distance, strict=True)  # a handful of blobs
    )
    return RockSightings(rocks, x, y)


def _lowest_row(yellow: NDArray[np.uint8], box: NDArray[np.int32]) -> float:
    """Where a blob ends below [px]: its colour, blurred by the JPEG file, falls to half there."""
    left, top, width, height = box
    rows = yellow[top : top + height + 3, left : left + width].max(axis=1).astype(float)
    half = rows.max() / 2
    last = int(np.nonzero(rows >= half)[0][-1])
    if last + 1 == len(rows):
        return float(top + last + 1)
    return float(top + last + 0.5 + (rows[last] - half) / (rows[last] - rows[last + 1]))


def _sighting(x: float, y: float, distance: float, view: View, pose: Pose) -> RockSighting:
    """Range errors grow with the square of the distance, sideways ones with the distance."""
    scale = view.height * view.camera.focal  # [m px]
    row_error = ROW_ERROR * distance**2 / scale
    along = np.hypot(row_error, distance * (HEIGHT_ERROR + view.height_error))
    across = np.hypot(COLUMN_ERROR * distance / view.camera.focal, BODY_ERROR)
    bearing = pose.yaw + np.arctan2(y - view.position[1], x - view.position[0])
    c, s = np.cos(bearing), np.sin(bearing)
    turn = np.array([[c, -s], [s, c]])
    covariance = turn @ np.diag([along**2, across**2]) @ turn.T
    c, s = np.cos(pose.yaw), np.sin(pose.yaw)
    return RockSighting(pose.x + c * x - s * y, pose.y + s * x + c * y, covariance)
