"""The frames of a mission's video: pictures, figures below them, the map beside."""

from __future__ import annotations

import textwrap
from typing import Generic, Protocol, TypeVar

import cv2
import numpy as np

from rover_tools.report.track import Moment
from rover_tools.report.video.colours import INK, MUTED, PANEL, colour_of
from rover_tools.report.video.lettering import write
from rover_tools.report.video.snapshot import Image

WIDTH, HEIGHT = 960, 360  # [px]
PANELS = (640, 160)  # [px] width, height of the pictures
MAP = (320, 360)  # [px]
BAND = 320, 344  # [px] from the top: the states so far
LEFT, RIGHT = 16, 624  # [px] of the figures' columns
COLUMNS = 6
CLOCK = 64  # [px] of the mission's time
LETTER = 8  # [px] of most letters of the reason


class HasMoment(Protocol):
    """A mission at one moment."""

    @property
    def moment(self) -> Moment: ...


S = TypeVar("S", bound=HasMoment)
In = TypeVar("In", bound=HasMoment, contravariant=True)


class Scene(Protocol[In]):
    """What is shown of one kind of missions; it takes one snapshot after another."""

    def panels(self, snapshot: In) -> Image:
        """The pictures beside each other, (160, 640, 3)."""

    def map(self, snapshot: In) -> Image:
        """(360, 320, 3)"""

    def figures(self, snapshot: In) -> list[tuple[str, str]]:
        """At most COLUMNS headings and values."""


class Composition(Generic[S]):
    """Makes one frame after another of one mission."""

    def __init__(self, scene: Scene[S]) -> None:
        self._scene = scene
        self._background = np.full((HEIGHT, WIDTH, 3), PANEL, np.uint8)
        self._states: list[tuple[float, str]] = []  # times [s] since when

    def frame(self, snapshot: S) -> Image:
        """The next frame (HEIGHT, WIDTH, 3)."""
        picture = self._background.copy()
        width, height = PANELS
        picture[:height, :width] = self._scene.panels(snapshot)
        picture[:, width:] = self._scene.map(snapshot)
        self._describe(picture, snapshot)
        self._draw_band(picture, snapshot.moment)
        return picture

    def _describe(self, picture: Image, snapshot: S) -> None:
        moment = snapshot.moment
        cv2.rectangle(picture, (LEFT, 184), (LEFT + 16, 200), colour_of(moment.state), cv2.FILLED)
        end = write(picture, moment.state, (LEFT + 26, 200), 20, INK, bold=True)
        room = RIGHT - CLOCK - end - 28
        reason = textwrap.shorten(moment.reason, max(1, room // LETTER), placeholder="…")
        write(picture, reason, (end + 14, 200), 14, MUTED)
        clock = f"{int(moment.time) // 60}:{int(moment.time) % 60:02d}"
        write(picture, clock, (RIGHT - CLOCK, 200), 20, INK, bold=True)
        for column, (heading, value) in enumerate(self._scene.figures(snapshot)):
            x = LEFT + column * (RIGHT - LEFT) // COLUMNS
            write(picture, heading, (x, 246), 12, MUTED)
            write(picture, value, (x, 272), 17, INK, bold=True)

    def _draw_band(self, picture: Image, moment: Moment) -> None:
        """The states so far, over all of the width."""
        if not self._states or self._states[-1][1] != moment.state:
            self._states.append((moment.time, moment.state))
        first = self._states[0][0]
        scale = (RIGHT - LEFT) / max(moment.time - first, 1e-9)
        for start, state in self._states:
            left = LEFT + round((start - first) * scale)
            corners = (left, BAND[0]), (RIGHT, BAND[1])
            cv2.rectangle(picture, *corners, colour_of(state), cv2.FILLED)
