"""What the Unity simulator's screen shows of its server's insets, saved as pictures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.whole_file import write_whole
from rover_simulator.sensors.jpeg import encode_jpeg

Picture = NDArray[np.uint8]  # (height, width, 3) RGB

WIDTH, HEIGHT = 1024, 768  # [px] of the original's window as its users usually choose it
MARGIN = 10  # [px]


@dataclass(frozen=True)
class Place:
    """Where the original shows a picture; its width follows from the picture's shape."""

    bottom: int  # [px] from the window's lower edge
    height: int  # [px]
    right: bool = False  # at the window's right edge, otherwise at its left


# As in the original's user interface, whose places are shares of the window's height.
CAMERA = Place(MARGIN, round(0.18 * HEIGHT) - MARGIN)
PLACES = {
    "inset_image1": Place(MARGIN, round(0.36 * HEIGHT) - MARGIN, right=True),
    "inset_image2": Place(round(0.18 * HEIGHT), round(0.18 * HEIGHT) - MARGIN),
}


def screen_picture(camera: Picture, insets: Mapping[str, Picture]) -> Picture:
    """The window (768, 1024, 3) RGB with the camera's image and those insets that there are.

    The original fills it with a view of the rover from behind. Nothing here renders that: the
    camera's image takes its place, at the top.
    """
    screen = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    height = WIDTH * camera.shape[0] // camera.shape[1]
    screen[:height] = cv2.resize(camera, (WIDTH, height))
    _put(screen, camera, CAMERA)
    for name, place in PLACES.items():
        if name in insets:
            _put(screen, insets[name], place)
    return screen


class SavedScreen:
    """Saves the insets that arrive as they came, and the screen that shows them."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._folder = folder
        self._insets: dict[str, Picture] = {}

    def show(self, time: float, camera: bytes, insets: Mapping[str, bytes]) -> None:
        """Insets by name that came at a simulated time [s]; `camera`: a JPEG file.

        As in the original, one that is empty or no image leaves the one before on the screen.
        """
        pictures = {name: _decoded(data) for name, data in insets.items()}
        shown = {name: picture for name, picture in pictures.items() if picture is not None}
        image = _decoded(camera)
        if not shown or image is None:
            return
        self._insets |= shown
        stem = f"{time:08.2f}"
        for name in shown:
            write_whole(self._folder / f"{stem}_{name}.jpg", insets[name])
        screen = encode_jpeg(screen_picture(image, self._insets))
        write_whole(self._folder / f"{stem}_screen.jpg", screen)


def _put(screen: Picture, picture: Picture, place: Place) -> None:
    height, width = picture.shape[:2]
    width = min(round(place.height * width / height), WIDTH - MARGIN)
    left = WIDTH - MARGIN - width if place.right else MARGIN
    top = HEIGHT - place.bottom - place.height
    resized = cv2.resize(picture, (width, place.height), interpolation=cv2.INTER_AREA)
    screen[top : top + place.height, left : left + width] = resized


def _decoded(data: bytes) -> Picture | None:
    """An image file as an array; None for what is none."""
    image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR) if data else None
    return None if image is None else cv2.cvtColor(image, cv2.COLOR_BGR2RGB).astype(np.uint8)
