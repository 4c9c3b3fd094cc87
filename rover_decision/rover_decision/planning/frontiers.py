"""Frontiers: where known free ground borders on the unknown."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from rover_decision.planning.costmap import Costmap

# [cells] 2.5 m: no way on is as narrow, and what a shorter border hides is not worth the way there
SMALLEST = 10
SQUARE = np.ones((3, 3), np.uint8)


@dataclass(frozen=True)
class Frontier:
    """One connected border."""

    x: NDArray[np.float64]  # (n,) [m] map frame, its cells
    y: NDArray[np.float64]  # (n,) [m]

    @property
    def length(self) -> int:
        """[cells]"""
        return len(self.x)


def find_frontiers(costmap: Costmap, visited: NDArray[np.float64]) -> list[Frontier]:
    """All borders of some length, the longest first; `visited` (n, 3) [m] as for near_visited."""
    # Unknown slivers of less than three cells vanish: they are grazed walls.
    unknown = cv2.morphologyEx(costmap.unknown.astype(np.uint8), cv2.MORPH_OPEN, SQUARE)
    border = costmap.free & (cv2.dilate(unknown, SQUARE) > 0)
    rows, cols = np.nonzero(border)
    border[rows, cols] = ~near_visited(*costmap.geometry.center_of(rows, cols), visited)
    labels, count = ndimage.label(border, structure=SQUARE)
    if count == 0:
        return []
    rows, cols = np.nonzero(border)
    order = np.argsort(labels[rows, cols], kind="stable")
    ends = np.cumsum(np.bincount(labels[rows, cols], minlength=count + 1)[1:])
    x, y = costmap.geometry.center_of(rows[order], cols[order])
    frontiers = [
        Frontier(*part) for part in zip(np.split(x, ends[:-1]), np.split(y, ends[:-1]), strict=True)
    ]
    large = [frontier for frontier in frontiers if frontier.length >= SMALLEST]
    return sorted(large, key=lambda frontier: -frontier.length)


def near_visited(
    x: NDArray[np.float64], y: NDArray[np.float64], visited: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Whether points (m,) [m] lie in the discs (n, 3) of places visited: x, y, radius [m]."""
    away = np.hypot(x - visited[:, :1], y - visited[:, 1:2])
    return np.asarray((away < visited[:, 2:]).any(axis=0))
