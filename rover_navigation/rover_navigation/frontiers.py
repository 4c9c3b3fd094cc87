"""Frontiers: where known free ground borders on the unknown."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from rover_navigation.costmap import Costmap
from rover_navigation.scale import Scale

# of an unknown patch amid known ground: the rest of it is the obstacle that hid it
PATCH_SHARE = 0.5
SQUARE = np.ones((3, 3), np.uint8)


@dataclass(frozen=True)
class Frontier:
    """One connected border."""

    resolution: float  # [m] of its cells
    x: NDArray[np.float64]  # (n,) [m] map frame, its cells
    y: NDArray[np.float64]  # (n,) [m]
    open: NDArray[np.bool_]  # (n,) not just the base of a wall that was seen from afar
    unknown_area: NDArray[np.float64]  # (n,) [m^2] connected unknown ground; inf: no end known

    @property
    def length(self) -> int:
        """[cells]"""
        return len(self.x)

    def leads_on(self, scale: Scale) -> bool:
        """Whether more ground may lie behind it; else it is a strip along a wall."""
        return int(np.count_nonzero(self.open)) >= scale.frontier_length / self.resolution

    def hidden_area(self, scale: Scale) -> float:
        """[m^2] of ground that there may be behind it; inf where no end of it is known."""
        patch = PATCH_SHARE * float(self.unknown_area.max())
        if self.leads_on(scale):
            return patch
        return min(patch, self.length * self.resolution * scale.strip_depth)


def find_frontiers(
    costmap: Costmap, blacklisted: NDArray[np.float64], scale: Scale
) -> list[Frontier]:
    """All borders of some length, the longest first; `blacklisted` (n, 3) as for in_discs.

    No passage is as narrow as a shorter border, and what it hides is not worth the time.
    """
    # Unknown slivers of less than three cells vanish: they are grazed walls.
    unknown = np.asarray(
        cv2.morphologyEx(costmap.unknown.astype(np.uint8), cv2.MORPH_OPEN, SQUARE), np.uint8
    )
    border = costmap.free & (cv2.dilate(unknown, SQUARE) > 0)
    rows, cols = np.nonzero(border)
    border[rows, cols] = ~in_discs(*costmap.geometry.center_of(rows, cols), blacklisted)
    labels, count = ndimage.label(border, structure=SQUARE)
    if count == 0:
        return []
    resolution = costmap.geometry.resolution
    rows, cols = np.nonzero(border)
    label = labels[rows, cols]
    sizes = np.bincount(label, minlength=count + 1)
    large = sizes[label] >= scale.frontier_length / resolution
    rows, cols, label = rows[large], cols[large], label[large]
    order = np.argsort(label, kind="stable")
    rows, cols, label = rows[order], cols[order], label[order]
    ends = np.flatnonzero(np.diff(label)) + 1
    nothing = (costmap.unknown & ~costmap.edge).astype(np.uint8)
    is_open = cv2.dilate(nothing, SQUARE)[rows, cols] > 0
    area = cv2.dilate(_areas(unknown, resolution), SQUARE)[rows, cols]
    columns = (*costmap.geometry.center_of(rows, cols), is_open, area)
    parts = zip(*(np.split(column, ends) for column in columns), strict=True)
    frontiers = [Frontier(resolution, *part) for part in parts if len(part[0])]
    return sorted(frontiers, key=lambda frontier: -frontier.length)


def _areas(unknown: NDArray[np.uint8], resolution: float) -> NDArray[np.float32]:
    """For each unknown cell the area [m^2] of its connected region, inf at the map's border."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(unknown, connectivity=4)
    areas = stats[:, cv2.CC_STAT_AREA].astype(np.float32) * np.float32(resolution**2)
    for edge in (labels[0], labels[-1], labels[:, 0], labels[:, -1]):
        areas[edge] = np.inf
    areas[0] = 0.0
    return np.asarray(areas[labels])


def in_discs(
    x: NDArray[np.float64], y: NDArray[np.float64], discs: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Whether points (m,) [m] lie in any of the discs (n, 3): x, y, radius [m]."""
    away = np.hypot(x - discs[:, :1], y - discs[:, 1:2])
    return np.asarray((away < discs[:, 2:]).any(axis=0))
