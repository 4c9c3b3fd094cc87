"""The frames of a mission's video: camera and vision, figures below them, the map beside."""

from __future__ import annotations

import cv2
import numpy as np

from rover_tools.report.map_layers import Window
from rover_tools.report.video.colours import (
    INK,
    MUTED,
    PAGE,
    PANEL,
    Colour,
    colour_of,
)
from rover_tools.report.video.map_view import MapView
from rover_tools.report.video.snapshot import Image, Snapshot

WIDTH, HEIGHT = 960, 360  # [px]
CAMERA = (320, 160)  # [px] width, height of a camera image
BAND = 320, 344  # [px] from the top: the states so far
LEFT, RIGHT = 16, 624  # [px] of the figures' columns


class Composition:
    """Makes one frame after another of one mission."""

    def __init__(self, window: Window) -> None:
        """window: the part of the map frame that the map shows."""
        self._map = MapView(window, WIDTH - 2 * CAMERA[0], HEIGHT)
        self._font = cv2.FontFace("sans")
        self._background = np.full((HEIGHT, WIDTH, 3), PANEL, np.uint8)
        self._states: list[tuple[float, str]] = []  # times [s] since when

    def frame(self, snapshot: Snapshot) -> Image:
        """The next frame (HEIGHT, WIDTH, 3)."""
        picture = self._background.copy()
        width, height = CAMERA
        for left, image in ((0, snapshot.camera), (width, snapshot.vision)):
            place = picture[:height, left : left + width]
            place[:] = PAGE if image is None else _fitted(image)
        picture[:, 2 * width :] = self._map.draw(snapshot)
        self._describe(picture, snapshot)
        self._draw_band(picture, snapshot)
        return picture

    def _describe(self, picture: Image, snapshot: Snapshot) -> None:
        moment = snapshot.moment
        cv2.rectangle(picture, (LEFT, 184), (LEFT + 16, 200), colour_of(moment.state), cv2.FILLED)
        end = self._write(picture, moment.state, LEFT + 26, 200, 22, 600)
        self._write(picture, moment.reason, end + 14, 200, 16, 400, MUTED)
        clock = f"{int(moment.time) // 60}:{int(moment.time) % 60:02d}"
        self._write(picture, clock, RIGHT - 52, 200, 22, 600)
        figures = [
            ("samples", f"{moment.samples} of {snapshot.samples_total}"),
            ("speed", f"{moment.speed:.1f} m/s"),
            ("home", f"{moment.home_distance:.0f} m"),
            ("driven", f"{moment.distance:.0f} m"),
        ]
        if snapshot.score is not None:
            mapped, fidelity = snapshot.score
            figures += [("mapped", f"{mapped:.1f} %"), ("fidelity", f"{fidelity:.1f} %")]
        for column, (heading, value) in enumerate(figures):
            x = LEFT + column * (RIGHT - LEFT) // 6
            self._write(picture, heading, x, 246, 13, 400, MUTED)
            self._write(picture, value, x, 272, 19, 600)

    def _draw_band(self, picture: Image, snapshot: Snapshot) -> None:
        """The states so far, over all of the width."""
        moment = snapshot.moment
        if not self._states or self._states[-1][1] != moment.state:
            self._states.append((moment.time, moment.state))
        first = self._states[0][0]
        scale = (RIGHT - LEFT) / max(moment.time - first, 1e-9)
        for start, state in self._states:
            left = LEFT + round((start - first) * scale)
            corners = (left, BAND[0]), (RIGHT, BAND[1])
            cv2.rectangle(picture, *corners, colour_of(state), cv2.FILLED)

    def _write(
        self,
        picture: Image,
        text: str,
        x: int,
        y: int,
        size: int,
        weight: int,
        colour: Colour = INK,
    ) -> int:
        """Text with its baseline at y [px]; where it ends [px]."""
        end, _ = cv2.putText(picture, text, (x, y), colour, self._font, size, weight)
        return int(end[0])


def _fitted(image: Image) -> Image:
    if image.shape[1::-1] == CAMERA:
        return image
    return cv2.resize(image, CAMERA, interpolation=cv2.INTER_AREA).astype(np.uint8)
