"""The rover's camera, whose image reaches the server a frame late."""

from __future__ import annotations

from collections.abc import Callable

from rover_common.geometry import Pose
from rover_simulator.sensors.jpeg import encode_jpeg, first_row_to_encode
from rover_simulator.sensors.renderer import Renderer


class Camera:
    """Holds two images as JPEG files: the newest, and that of the frame before."""

    def __init__(self, renderer: Renderer, first_row: Callable[[Pose], int]) -> None:
        """first_row: of the image at a pose, from which on it has to be right.

        These rows decode to the same pixels as those of the whole image; rows far above stay black.
        """
        self.first_row = first_row
        self._renderer = renderer
        self._before = self._newest = b""
        self._captured_at: Pose | None = None  # None: the next image differs in any case

    @property
    def image(self) -> bytes:
        """That of the frame before, where there was one."""
        return self._before or self._newest

    def hide_sample(self, x: float, y: float) -> None:
        """The sample at this place [m] is gone, if one was there."""
        if self._renderer.hide_sample(x, y):
            self._captured_at = None

    def advance(self, pose: Pose, ground: float) -> None:
        """The next frame, at a pose on ground of this height [m]."""
        self._before = self._newest
        self.capture(pose, ground)

    def capture(self, pose: Pose, ground: float) -> None:
        """Replace the newest image; a body that is held sees the same as a frame ago."""
        if pose == self._captured_at:
            return
        self._captured_at = pose
        first_row = first_row_to_encode(self.first_row(pose))
        self._newest = encode_jpeg(self._renderer.render(pose, ground, first_row).image)
