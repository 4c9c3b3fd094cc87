"""Pixels that are hot wherever the robot looks."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_heat.thermal.detection import PIXELS, WarmPatch

TURNED = math.radians(40.0)  # [rad] five pixels: no patch on a wall stays in one for so long


class StuckPixels:
    """Of one sensor. A pixel that stayed alone hot while the robot turned is left out from then on.

    It is given its frame's median instead.
    """

    def __init__(self) -> None:
        self._stuck = np.zeros((PIXELS, PIXELS), bool)
        self._pixel: tuple[int, int] | None = None  # alone hot since some frames
        self._yaws = (0.0, 0.0)  # [rad] least and greatest since then

    @property
    def count(self) -> int:
        return int(self._stuck.sum())

    def memory(self) -> list[Any]:
        """Rows and columns of those that are left out, for JSON."""
        return np.argwhere(self._stuck).tolist()

    def restore(self, memory: list[Any]) -> None:
        """Take what `memory` gave; raises ValueError or TypeError for anything else."""
        pixels = np.array(memory, int).reshape(-1, 2)
        if ((pixels < 0) | (pixels >= PIXELS)).any():
            raise ValueError("no such pixel")
        self._stuck[tuple(pixels.T)] = True

    def mended(self, celsius: NDArray[np.float64]) -> NDArray[np.float64]:
        """The frame (8, 8) [C] without what they say."""
        if not self._stuck.any():
            return celsius
        return np.where(self._stuck, np.median(celsius[~self._stuck]), celsius)

    def update(self, patch: WarmPatch | None, yaw: float) -> bool:
        """One frame of a mended sensor; whether a pixel proved to be stuck.

        yaw: [rad] of the robot, not wrapped.
        """
        if patch is None or not patch.alone:
            self._pixel = None
            return False
        if patch.pixel != self._pixel:
            self._pixel, self._yaws = patch.pixel, (yaw, yaw)
        self._yaws = min(self._yaws[0], yaw), max(self._yaws[1], yaw)
        if self._yaws[1] - self._yaws[0] < TURNED:
            return False
        self._stuck[patch.pixel] = True
        self._pixel = None
        return True
