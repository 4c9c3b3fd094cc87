"""Frontiers: where known free ground borders on the unknown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_navigation.costmap import Costmap
from rover_navigation.run_length import RunLengthRegions, labels_of_cells
from rover_navigation.scale import Scale

# of an unknown patch amid known ground: the rest of it is the obstacle that hid it
PATCH_SHARE = 0.5
REACH = 3  # [cells]
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


class Borders(NamedTuple):
    """Where a frontier may be, (rows, cols) each; a cell depends on those REACH around it."""

    unknown: NDArray[np.uint8]  # but slivers of less than three cells, which are grazed walls
    border: NDArray[np.bool_]  # free cells beside these
    beside_nothing: NDArray[np.bool_]  # beside unknown cells that are not edges seen from afar

    @classmethod
    def of(cls, costmap: Costmap) -> Borders:
        unknown = np.asarray(
            cv2.morphologyEx(costmap.unknown.view(np.uint8), cv2.MORPH_OPEN, SQUARE), np.uint8
        )
        nothing = (costmap.unknown & ~costmap.edge).view(np.uint8)
        border = costmap.free & cv2.dilate(unknown, SQUARE).view(bool)
        return cls(unknown, border, cv2.dilate(nothing, SQUARE).view(bool))

    def part(self, cells: tuple[slice, slice]) -> Borders:
        """Some of the cells, as views."""
        return Borders(self.unknown[cells], self.border[cells], self.beside_nothing[cells])


def find_frontiers(
    costmap: Costmap,
    blacklisted: NDArray[np.float64],
    scale: Scale,
    borders: Borders | None = None,
) -> list[Frontier]:
    """All borders of some length, the longest first; `blacklisted` (n, 3) as for in_discs.

    No passage is as narrow as a shorter border, and what it hides is not worth the time. `borders`:
    those of the costmap, where they are known.
    """
    unknown, border, beside_nothing = borders or Borders.of(costmap)
    resolution = costmap.geometry.resolution
    rows, cols = np.divmod(np.flatnonzero(border), border.shape[1])
    wanted = ~in_discs(*costmap.geometry.center_of(rows, cols), blacklisted)
    rows, cols = rows[wanted], cols[wanted]
    label = labels_of_cells(rows, cols)
    large = np.bincount(label)[label] >= scale.frontier_length / resolution
    order = np.flatnonzero(large)[np.argsort(label[large], kind="stable")]
    if len(order) == 0:
        return []
    rows, cols, ends = rows[order], cols[order], np.flatnonzero(np.diff(label[order])) + 1
    area = _areas_beside(unknown, rows, cols) * np.float32(resolution**2)
    columns = (*costmap.geometry.center_of(rows, cols), beside_nothing[rows, cols], area)
    parts = zip(*(np.split(column, ends) for column in columns), strict=True)
    frontiers = [Frontier(resolution, *part) for part in parts]
    return sorted(frontiers, key=lambda frontier: -frontier.length)


def _areas_beside(
    unknown: NDArray[np.uint8], rows: NDArray[np.intp], cols: NDArray[np.intp]
) -> NDArray[np.float32]:
    """For each cell (n,) the largest region of unknown cells that touches it [cells]."""
    regions = RunLengthRegions(unknown)
    steps = [(down, right) for down in (-1, 0, 1) for right in (-1, 0, 1)]
    return np.max([regions.sizes_at(rows + down, cols + right) for down, right in steps], axis=0)


def in_discs(
    x: NDArray[np.float64], y: NDArray[np.float64], discs: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Whether points (m,) [m] lie in any of the discs (n, 3): x, y, radius [m]."""
    away = np.hypot(x - discs[:, :1], y - discs[:, 1:2])
    return np.asarray((away < discs[:, 2:]).any(axis=0))
