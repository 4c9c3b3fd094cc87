"""A part of the map frame as a picture, and what is drawn into it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, compose, compose_points, inverse
from rover_common.map_encoding import EDGE, navigable_cells
from rover_common.types import GridMap
from rover_tools.report.map_layers import Window
from rover_tools.report.track import Moment
from rover_tools.report.video.colours import GROUND, INK, OBSTACLE, PAGE, UNKNOWN, colour_of
from rover_tools.report.video.snapshot import Image

SHIFT = 4  # bits of the fraction of a pixel that OpenCV draws with
ORIGIN = Pose(0.0, 0.0, 0.0)
ROBOT = np.array([(9.0, 0.0), (-7.0, 6.0), (-4.0, 0.0), (-7.0, -6.0)])  # [px] nose to the right
SQUARE = 4.0 * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])  # [px]
PALETTE = np.array([UNKNOWN, GROUND, OBSTACLE], np.uint8)

Points = NDArray[np.float64]  # (n, 2)


class Canvas:
    """Draws one window into pictures of one size; all places are [m] in the map frame."""

    def __init__(self, window: Window, width: int, height: int, frame: Pose = ORIGIN) -> None:
        """width, height [px]; frame: the map's, in the frame that the window is given in."""
        self._size = width, height
        self._scale = min(width / window.width, height / window.height)  # [px/m]
        west = window.x - (width / self._scale - window.width) / 2
        north = -window.y + (height / self._scale - window.height) / 2
        self._corner = np.array([west, north])  # [m] of the picture's upper left corner
        self._frame = frame

    def cells(self, grid: GridMap | None) -> Image:
        """A new picture (height, width, 3) of what a map knows."""
        if grid is None:
            return np.full((*self._size[::-1], 3), UNKNOWN, np.uint8)
        kinds = np.select([navigable_cells(grid.cells), grid.cells > EDGE], [1, 2], 0)
        # The middles of the first pixel and of its neighbours to the right and below, as cells.
        pixels = np.array([(0.5, 0.5), (1.5, 0.5), (0.5, 1.5)])
        places = compose_points(
            inverse(self._frame), self._corner + pixels / (self._scale, -self._scale)
        )
        # OpenCV's nearest cell is that with the nearest whole number.
        first, right, below = (places - (grid.origin_x, grid.origin_y)) / grid.resolution - 0.5
        to_cells = np.column_stack([right - first, below - first, first])
        how = cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP
        picture = cv2.warpAffine(
            PALETTE.take(kinds, axis=0), to_cells, self._size, flags=how, borderValue=UNKNOWN
        )
        return np.asarray(picture, np.uint8)

    def line(
        self,
        picture: Image,
        points: Points,
        colour: Sequence[int],
        width: int,
        closed: bool = False,
    ) -> None:
        """Through places; width [px]."""
        if len(points) > 1:
            pixels = _fixed(self.pixels(points))
            cv2.polylines(picture, [pixels], closed, colour, width, cv2.LINE_AA, SHIFT)

    def area(self, picture: Image, corners: Points, colour: Sequence[int]) -> None:
        """A polygon between places."""
        cv2.fillPoly(picture, [_fixed(self.pixels(corners))], colour, cv2.LINE_AA, SHIFT)

    def symbols(self, picture: Image, places: Points, shape: Points, colour: Sequence[int]) -> None:
        """The same polygon [px], with a dark edge, at each place."""
        for place in self.pixels(places):
            _fill(picture, place + shape, colour)

    def robot(self, picture: Image, pose: Pose) -> None:
        yaw = compose(self._frame, pose).yaw
        turn = np.array([(math.cos(yaw), -math.sin(yaw)), (math.sin(yaw), math.cos(yaw))])
        self.symbols(picture, np.array([(pose.x, pose.y)]), ROBOT @ turn.T * (1, -1), INK)

    def pixels(self, points: Points) -> Points:
        """Places (n, 2) [m] in pixels, x to the right and y down."""
        placed = compose_points(self._frame, points)
        return (placed - self._corner) * (self._scale, -self._scale)


class TrackMemory:
    """The track so far, in the colours of the states."""

    def __init__(self) -> None:
        self._track: list[tuple[str, list[tuple[float, float]]]] = []

    def add(self, moment: Moment) -> None:
        """The next moment."""
        place = moment.pose.x, moment.pose.y
        if not self._track or self._track[-1][0] != moment.state:
            before = self._track[-1][1][-1:] if self._track else []
            self._track.append((moment.state, before))
        self._track[-1][1].append(place)

    def draw(self, canvas: Canvas, picture: Image, width: int = 2) -> None:
        """With the start; width [px]."""
        for state, points in self._track:
            canvas.line(picture, np.array(points), colour_of(state), width)
        start = np.array(self._track[0][1][:1])
        canvas.symbols(picture, start, SQUARE, INK)


def _fill(picture: Image, pixels: Points, colour: Sequence[int]) -> None:
    """A polygon with a dark edge."""
    corners = [_fixed(pixels)]
    cv2.fillPoly(picture, corners, colour, cv2.LINE_AA, SHIFT)
    cv2.polylines(picture, corners, True, PAGE, 1, cv2.LINE_AA, SHIFT)


def _fixed(pixels: Points) -> NDArray[np.int32]:
    return np.round(pixels * (1 << SHIFT)).astype(np.int32)
