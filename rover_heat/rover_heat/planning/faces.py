"""Faces of walls on the map, and which of them have been examined for heat."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_heat.planning.site import Site
from rover_heat.thermal.coverage import Examined, sectors_around
from rover_navigation.types import NO_POINTS

Points = NDArray[np.float64]
CROSS = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))
BLUR = 1.0  # [cells] deviation: less would show the steps of a wall that lies across the grid
SUSPECT = 0.15  # [m] around a place that was warm too seldom
NORMALS = 64  # directions that normals are rounded to


@dataclass(frozen=True)
class Faces:
    """Free cells before walls (n,)."""

    points: Points  # (n, 2) [m]
    normals: NDArray[np.float64]  # (n,) [rad] off the wall
    examined: NDArray[np.bool_]  # (n,)


def find_faces(site: Site, examined: Examined, suspects: Points = NO_POINTS) -> Faces:
    """All on the map, reachable or not.

    suspects (n, 2) [m]: places that were warm too seldom to be a source: they are open again.
    """
    walls = site.walls.astype(np.uint8)
    before = (cv2.dilate(walls, CROSS) > 0) & ~site.walls & ~site.costmap.unknown
    rows, cols = np.nonzero(before)
    soft = cv2.GaussianBlur(walls.astype(np.float32), (0, 0), BLUR)
    slope_x = cv2.Sobel(soft, cv2.CV_32F, 1, 0)[rows, cols]
    slope_y = cv2.Sobel(soft, cv2.CV_32F, 0, 1)[rows, cols]
    normals = np.arctan2(-slope_y, -slope_x).astype(float)
    numbers = np.round(normals / (2.0 * np.pi) * NORMALS).astype(int) % NORMALS
    seen = examined.raster(site.geometry)[rows, cols] & ENOUGH[numbers]
    points = np.stack(site.geometry.center_of(rows, cols), axis=1)
    away = np.hypot(*(points[:, None] - suspects[None]).transpose(2, 0, 1))
    return Faces(points, normals, (seen > 0) & (away > SUSPECT).all(axis=1))


ENOUGH = np.array(
    [sectors_around(2.0 * np.pi * number / NORMALS) for number in range(NORMALS)], np.uint32
)
