"""The insets of an answer: pictures of map and ground for the simulator's screen."""

from __future__ import annotations

import base64
import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.ground_truth import CELLS as TRUTH_CELLS
from rover_common.jpeg import sharp_jpeg
from rover_common.map_encoding import UNKNOWN, navigable_cells
from rover_common.types import GridMap

Picture = NDArray[np.uint8]  # (height, width, 3) RGB

PIXELS = GridGeometry.of_world(0.5)  # of the map's picture, before its first row is put below
QUALITY = 85  # of the JPEG files
ROVER, TRACK, ROCK = (255, 255, 255), (235, 200, 150), (255, 255, 0)
ROVER_RADIUS, ROCK_RADIUS = 2.0, 1.5  # [m] drawn, larger than life
HEADING = 7.0  # [m] length of the line that shows where the rover is headed

# Colour of a cell by what the map says (unknown, obstacle, navigable) and what the truth says (not
# given, obstacle, navigable).
CELL_COLORS = np.array(
    [
        [(25, 25, 25), (25, 25, 25), (30, 95, 40)],
        [(150, 45, 45), (150, 45, 45), (200, 60, 200)],  # pink: navigable, but not mapped so
        [(60, 105, 225), (240, 140, 30), (60, 105, 225)],  # orange: mapped navigable, but is not
    ],
    np.uint8,
)


@dataclass(frozen=True)
class Insets:
    """What an answer carries: JPEG files in base64, empty where the client keeps what it shows."""

    map: str = ""
    birdseye: str = ""


NO_INSETS = Insets()


@dataclass(frozen=True)
class MapScene:
    """What the picture of the map shows."""

    pose: Pose
    grid: GridMap | None = None
    truth: NDArray[np.bool_] | None = None  # (200, 200), as load_truth gives it
    track: NDArray[np.float64] | None = None  # (n, 2) [m] map frame
    rocks: NDArray[np.float64] | None = None  # (n, 2) [m] map frame


def map_inset(scene: MapScene) -> Picture:
    """The map (400, 400, 3) RGB, north above; rover white, track beige, rocks yellow."""
    picture = np.ascontiguousarray(CELL_COLORS[_mapped(scene.grid), _true(scene.truth)][::-1])
    if scene.track is not None and len(scene.track):
        line = [_pixels_of(scene.track)]
        cv2.polylines(picture, line, isClosed=False, color=TRACK)
    for point in _pixels_of(scene.rocks) if scene.rocks is not None else ():
        cv2.circle(picture, point.tolist(), _length(ROCK_RADIUS), ROCK, cv2.FILLED)
    _draw_rover(picture, scene.pose)
    return picture


def encode_inset(picture: Picture) -> str:
    """A JPEG file in base64."""
    return base64.b64encode(sharp_jpeg(picture, QUALITY)).decode("ascii")


def _mapped(grid: GridMap | None) -> NDArray[np.uint8]:
    """Row of CELL_COLORS for each pixel (400, 400)."""
    if grid is None:
        return np.zeros((PIXELS.rows, PIXELS.cols), np.uint8)
    rows, cols = grid.cells.shape
    geometry = GridGeometry(grid.resolution, rows, cols, grid.origin_x, grid.origin_y)
    classes = (grid.cells != UNKNOWN).astype(np.uint8) + navigable_cells(grid.cells)
    return classes[_cells_of_pixels(geometry)]


def _true(truth: NDArray[np.bool_] | None) -> NDArray[np.uint8]:
    """Column of CELL_COLORS for each pixel (400, 400)."""
    if truth is None:
        return np.zeros((PIXELS.rows, PIXELS.cols), np.uint8)
    return (truth.astype(np.uint8) + 1)[_cells_of_pixels(TRUTH_CELLS)]


def _cells_of_pixels(geometry: GridGeometry) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows (400, 1) and columns (1, 400) of the cells that the pixels show."""
    x, y = PIXELS.center_of(np.arange(PIXELS.rows), np.arange(PIXELS.cols))
    row, col = geometry.nearest_cell_to(x, y)
    return row[:, None], col[None, :]


def _draw_rover(picture: Picture, pose: Pose) -> None:
    ahead = (pose.x + HEADING * math.cos(pose.yaw), pose.y + HEADING * math.sin(pose.yaw))
    center, tip = _pixels_of(np.array([(pose.x, pose.y), ahead])).tolist()
    cv2.line(picture, center, tip, ROVER)
    cv2.circle(picture, center, _length(ROVER_RADIUS), ROVER, cv2.FILLED)


def _pixels_of(points: NDArray[np.float64]) -> NDArray[np.int32]:
    """Column and row (n, 2) of the pixels that show points (n, 2) [m]."""
    row, col = PIXELS.cell_of(points[:, 0], points[:, 1])
    return np.column_stack([col, PIXELS.rows - 1 - row]).astype(np.int32)


def _length(meters: float) -> int:
    """[px]"""
    return round(meters / PIXELS.resolution)
