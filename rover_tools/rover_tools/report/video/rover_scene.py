"""What a video shows of the rover: camera and vision, the map, its figures."""

from __future__ import annotations

import cv2
import numpy as np

from rover_tools.report.map_layers import Window
from rover_tools.report.video.canvas import Canvas, TrackMemory
from rover_tools.report.video.colours import INK, PAGE, YELLOW
from rover_tools.report.video.composition import MAP, PANELS
from rover_tools.report.video.snapshot import Image, Snapshot

CAMERA = (320, 160)  # [px] width, height of a camera image
DIAMOND = np.array([(0.0, 5.0), (5.0, 0.0), (0.0, -5.0), (-5.0, 0.0)])  # [px]


class RoverScene:
    """Takes one snapshot after another of one mission."""

    def __init__(self, window: Window, map_size: tuple[int, int] = MAP) -> None:
        """window: the part of the map frame that the map shows."""
        self._canvas = Canvas(window, *map_size)
        self._track = TrackMemory()

    def panels(self, snapshot: Snapshot) -> Image:
        picture = np.empty((PANELS[1], PANELS[0], 3), np.uint8)
        for left, image in ((0, snapshot.camera), (CAMERA[0], snapshot.vision)):
            picture[:, left : left + CAMERA[0]] = PAGE if image is None else _fitted(image)
        return picture

    def map(self, snapshot: Snapshot) -> Image:
        canvas = self._canvas
        self._track.add(snapshot.moment)
        picture = canvas.cells(snapshot.grid)
        self._track.draw(canvas, picture)
        canvas.line(picture, snapshot.path, INK, 1)
        canvas.symbols(picture, snapshot.rocks, DIAMOND, YELLOW)
        canvas.robot(picture, snapshot.moment.pose)
        return picture

    def figures(self, snapshot: Snapshot) -> list[tuple[str, str]]:
        moment = snapshot.moment
        figures = [
            ("samples", f"{moment.samples} of {snapshot.samples_total}"),
            ("speed", f"{moment.speed:.1f} m/s"),
            ("home", f"{moment.home_distance:.0f} m"),
            ("driven", f"{moment.distance:.0f} m"),
        ]
        if snapshot.score is not None:
            mapped, fidelity = snapshot.score
            figures += [("mapped", f"{mapped:.1f} %"), ("fidelity", f"{fidelity:.1f} %")]
        return figures


def _fitted(image: Image) -> Image:
    if image.shape[1::-1] == CAMERA:
        return image
    return cv2.resize(image, CAMERA, interpolation=cv2.INTER_AREA).astype(np.uint8)
