"""The map with the rover, as a picture."""

from __future__ import annotations

import math
from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.map_encoding import EDGE, navigable_cells
from rover_common.types import GridMap
from rover_tools.report.map_layers import Window
from rover_tools.report.video.colours import (
    GROUND,
    INK,
    OBSTACLE,
    PAGE,
    UNKNOWN,
    YELLOW,
    colour_of,
)
from rover_tools.report.video.snapshot import Image, Snapshot

SHIFT = 4  # bits of the fraction of a pixel that OpenCV draws with
ROVER = np.array([(9.0, 0.0), (-7.0, 6.0), (-4.0, 0.0), (-7.0, -6.0)])  # [px] nose to the right
DIAMOND = np.array([(0.0, 5.0), (5.0, 0.0), (0.0, -5.0), (-5.0, 0.0)])  # [px]
PALETTE = np.array([UNKNOWN, GROUND, OBSTACLE], np.uint8)


class MapView:
    """Draws one window of the map frame into pictures of one size, and remembers the track."""

    def __init__(self, window: Window, width: int, height: int) -> None:
        """width, height [px]"""
        self._size = width, height
        self._scale = min(width / window.width, height / window.height)  # [px/m]
        west = window.x - (width / self._scale - window.width) / 2
        north = -window.y + (height / self._scale - window.height) / 2
        self._corner = np.array([west, north])  # [m] of the picture's upper left corner
        self._track: list[tuple[str, list[tuple[float, float]]]] = []

    def draw(self, snapshot: Snapshot) -> Image:
        """The picture (height, width, 3) of the next snapshot."""
        self._remember(snapshot)
        picture = self._cells(snapshot.grid)
        for state, points in self._track:
            self._line(picture, np.array(points), colour_of(state), 2)
        self._line(picture, snapshot.path, INK, 1)
        start = self._pixels(np.array(self._track[0][1][:1]))
        _fill(picture, start + 6 * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) / 1.5, INK)
        for rock in self._pixels(snapshot.rocks):
            _fill(picture, rock + DIAMOND, YELLOW)
        pose = snapshot.moment.pose
        turn = np.array([(math.cos(pose.yaw), -math.sin(pose.yaw)),
                         (math.sin(pose.yaw), math.cos(pose.yaw))])  # fmt: skip
        body = ROVER @ turn.T * (1, -1)
        _fill(picture, self._pixels(np.array([(pose.x, pose.y)])) + body, INK)
        return picture

    def _remember(self, snapshot: Snapshot) -> None:
        moment = snapshot.moment
        place = moment.pose.x, moment.pose.y
        if not self._track or self._track[-1][0] != moment.state:
            before = self._track[-1][1][-1:] if self._track else []
            self._track.append((moment.state, before))
        self._track[-1][1].append(place)

    def _cells(self, grid: GridMap | None) -> Image:
        if grid is None:
            return np.full((*self._size[::-1], 3), UNKNOWN, np.uint8)
        kinds = np.select([navigable_cells(grid.cells), grid.cells > EDGE], [1, 2], 0)
        step = 1.0 / (self._scale * grid.resolution)  # cells from one pixel to the next
        west, north = self._corner
        # Of a pixel's centre; OpenCV's nearest cell is that with the nearest whole number.
        col = (west - grid.origin_x) / grid.resolution + 0.5 * step - 0.5
        row = (north - grid.origin_y) / grid.resolution - 0.5 * step - 0.5
        to_cells = np.array([(step, 0.0, col), (0.0, -step, row)])
        how = cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP
        picture = cv2.warpAffine(
            PALETTE.take(kinds, axis=0), to_cells, self._size, flags=how, borderValue=UNKNOWN
        )
        return np.asarray(picture, np.uint8)

    def _pixels(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (n, 2) [m] in pixels, x to the right and y down."""
        return (points - self._corner) * (self._scale, -self._scale)

    def _line(
        self, picture: Image, points: NDArray[np.float64], colour: Sequence[int], width: int
    ) -> None:
        if len(points) > 1:
            pixels = _fixed(self._pixels(points))
            cv2.polylines(picture, [pixels], False, colour, width, cv2.LINE_AA, SHIFT)


def _fill(picture: Image, pixels: NDArray[np.float64], colour: Sequence[int]) -> None:
    """A polygon with a dark edge."""
    corners = [_fixed(pixels)]
    cv2.fillPoly(picture, corners, colour, cv2.LINE_AA, SHIFT)
    cv2.polylines(picture, corners, True, PAGE, 1, cv2.LINE_AA, SHIFT)


def _fixed(pixels: NDArray[np.float64]) -> NDArray[np.int32]:
    return np.round(pixels * (1 << SHIFT)).astype(np.int32)
